# hauberk_add_plugin(<id> KIND shape|load_case|optimizer|several SOURCES <file>... [LIBRARIES <target>...]
#                    [OUTPUT_DIRECTORY <dir>])
#
# Builds the plugin <id> as <id>.so. Only the table `hauberk_plugin` is exported, or of KIND several, a library of
# plugins with ids of their own, the list `hauberk_plugins` (hauberk/kit/plugin_table.hpp). In Hauberk's own tree the
# library goes where the program looks first; elsewhere to <build>/plugins, for --plugin-path.
function(hauberk_add_plugin id)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "KIND;OUTPUT_DIRECTORY" "SOURCES;LIBRARIES")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "hauberk_add_plugin(${id}): unknown arguments ${arg_UNPARSED_ARGUMENTS}")
  endif()
  if(NOT arg_KIND MATCHES "^(shape|load_case|optimizer|several)$")
    message(FATAL_ERROR "hauberk_add_plugin(${id}): KIND must be shape, load_case, optimizer or several")
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
               INSTALL_RPATH "$ORIGIN/../.."
               # CMake pads a run path that it is to change at installation with colons, and the loader takes what is
               # empty between them for the current directory.
               INSTALL_RPATH_USE_LINK_PATH ON
               BUILD_WITH_INSTALL_RPATH ON)
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

# hauberk_install_plugins(<id>...)
#
# `cmake --install` puts these beside the plugins of the Hauberk that was found, where it looks for them; with --prefix
# PREFIX, or where CMAKE_INSTALL_PREFIX is given, into PREFIX/lib/hauberk/plugins, for HAUBERK_PLUGIN_PATH.
function(hauberk_install_plugins)
  if(PROJECT_IS_TOP_LEVEL AND CMAKE_INSTALL_PREFIX_INITIALIZED_TO_DEFAULT)
    set_property(CACHE CMAKE_INSTALL_PREFIX PROPERTY VALUE "${hauberk_PREFIX}")
  endif()
  install(TARGETS ${ARGN} LIBRARY DESTINATION lib/hauberk/plugins)
endfunction()
