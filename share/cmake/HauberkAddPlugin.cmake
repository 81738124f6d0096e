# hauberk_add_plugin(<id> KIND shape|load_case|optimizer SOURCES <file>... [LIBRARIES <target>...]
#                    [OUTPUT_DIRECTORY <dir>])
#
# Builds the plugin <id> as <id>.so. Only the table `hauberk_plugin` is exported. In Hauberk's own tree the
# library goes where the program looks first; elsewhere to <build>/plugins, for --plugin-path.
function(hauberk_add_plugin id)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "KIND;OUTPUT_DIRECTORY" "SOURCES;LIBRARIES")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "hauberk_add_plugin(${id}): unknown arguments ${arg_UNPARSED_ARGUMENTS}")
  endif()
  if(NOT arg_KIND MATCHES "^(shape|load_case|optimizer)$")
    message(FATAL_ERROR "hauberk_add_plugin(${id}): KIND must be shape, load_case or optimizer")
  endif()
  if(NOT arg_SOURCES)
    message(FATAL_ERROR "hauberk_add_plugin(${id}): SOURCES is missing")
  endif()
  if(NOT arg_OUTPUT_DIRECTORY)
    if(HAUBERK_PLUGIN_OUTPUT_DIRECTORY)
      set(arg_OUTPUT_DIRECTORY "${HAUBERK_PLUGIN_OUTPUT_DIRECTORY}")
      set(in_tree TRUE)
    else()
      set(arg_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/plugins")
    endif()
  endif()

  add_library(${id} MODULE ${arg_SOURCES})
  target_link_libraries(${id} PRIVATE hauberk::kernel ${arg_LIBRARIES})
  if(TARGET hauberk_warnings)
    target_link_libraries(${id} PRIVATE hauberk_warnings)
  endif()
  target_compile_features(${id} PRIVATE cxx_std_20)
  set_target_properties(
    ${id}
    PROPERTIES PREFIX ""
               SUFFIX ".so"
               OUTPUT_NAME "${id}"
               CXX_VISIBILITY_PRESET hidden
               VISIBILITY_INLINES_HIDDEN ON
               LIBRARY_OUTPUT_DIRECTORY "${arg_OUTPUT_DIRECTORY}"
               INSTALL_RPATH "$ORIGIN/../..")
  if(NOT HAUBERK_SANITIZE)
    # A missing symbol should fail here, not when a user loads the plugin. (Sanitizer runtimes are resolved
    # from the program.)
    target_link_options(${id} PRIVATE -Wl,-z,defs)
  endif()
  if(in_tree)
    set_property(GLOBAL APPEND PROPERTY HAUBERK_PLUGIN_TARGETS ${id})
    install(TARGETS ${id} LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/hauberk/plugins")
  endif()
endfunction()
