# hauberk_on_demand(<name> SOURCES <file>... LIBRARIES <target>...)
#
# Builds <name>.so, which the program loads where it needs it (kernel/numerics/on_demand.hpp), and nothing of what the
# program links: it holds what needs other people's libraries and few scenes use.
function(hauberk_on_demand name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBRARIES")
  add_library(${name} MODULE ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} hauberk_warnings)
  target_compile_features(${name} PRIVATE cxx_std_20)
  set_target_properties(
    ${name}
    PROPERTIES PREFIX ""
               SUFFIX ".so"
               CXX_VISIBILITY_PRESET hidden
               VISIBILITY_INLINES_HIDDEN ON
               LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib/hauberk/on_demand"
               INSTALL_RPATH ""
               BUILD_WITH_INSTALL_RPATH ON)
  if(NOT HAUBERK_SANITIZE)
    target_link_options(${name} PRIVATE -Wl,-z,defs)
  endif()
  set_property(GLOBAL APPEND PROPERTY HAUBERK_ON_DEMAND_TARGETS ${name})
  install(TARGETS ${name} LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/hauberk/on_demand")
endfunction()
