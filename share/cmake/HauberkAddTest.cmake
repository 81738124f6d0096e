# hauberk_add_test(<name> SOURCES <file>... [LIBRARIES <target>...] [DEFINITIONS <definition>...] [SEPARATE])
#
# SEPARATE: files share names in unnamed namespaces and cannot be joined.
#
# A GoogleTest program <build>/bin/tests/<name>; each of its tests is one for ctest, named <name>.<suite>.<test>.
# The kernel is linked, with all that is inside; the macro HAUBERK_BINARY_DIR is the build folder, HAUBERK_SOURCE_DIR the checkout.
function(hauberk_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "SEPARATE" "" "SOURCES;LIBRARIES;DEFINITIONS")
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_SOURCES)
    message(FATAL_ERROR "hauberk_add_test(${name}): SOURCES missing, or unknown ${arg_UNPARSED_ARGUMENTS}")
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} hauberk::mechanics hauberk_warnings GTest::gtest_main)
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/tests/support")
  target_compile_options(${name} PRIVATE "${HAUBERK_TEST_OPTIONS}")
  target_compile_definitions(
    ${name} PRIVATE HAUBERK_BINARY_DIR="${PROJECT_BINARY_DIR}" HAUBERK_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                    ${arg_DEFINITIONS})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin/tests")
  if(arg_LIBRARIES MATCHES "hauberk::results|hauberk::document|hauberk::run|hauberk::experiment|hauberk::verify|hauberk::report|hauberk::pictures|hauberk::tasks|hauberk_command_parts")
    hauberk_precompile(${name} JSON TEST)
  else()
    hauberk_precompile(${name} TEST)
  endif()
  if(NOT arg_SEPARATE)
    hauberk_join(${name})
  endif()
  gtest_discover_tests(${name} TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
endfunction()
