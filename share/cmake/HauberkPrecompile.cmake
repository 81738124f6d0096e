# Reading the headers of the standard library, Eigen, Boost.JSON, fmt and GoogleTest is most of what compiling most
# files takes. A compiler cache spares it too and does not go well with precompiled headers; builds with one also see to
# it that every file includes what it uses.
if(HAUBERK_CCACHE)
  set(HAUBERK_PRECOMPILE_DEFAULT OFF)
else()
  set(HAUBERK_PRECOMPILE_DEFAULT ON)
endif()
option(HAUBERK_PRECOMPILE "Precompile the headers of libraries (never our own)" ${HAUBERK_PRECOMPILE_DEFAULT})

set(HAUBERK_PRECOMPILED
    <algorithm> <array> <cmath> <filesystem> <fstream> <functional> <limits> <map> <memory> <numbers> <optional> <span>
    <sstream> <string> <string_view> <utility> <vector> <fmt/format.h> <Eigen/Dense>)

# How tests are compiled: what takes time in them is in the kernel and in libraries, which are optimised and keep their
# lines. What is precompiled for tests must be compiled alike.
set(HAUBERK_TEST_OPTIONS "$<$<CONFIG:RelWithDebInfo>:-O1;-g0>")

# hauberk_precompile(<target> [HIDDEN] [JSON] [TEST])
#
# What is precompiled depends on the options of the compiler, so there is one set for each combination: HIDDEN for
# targets that hide their symbols, JSON for those that link Boost.JSON, TEST for programs with GoogleTest. All must link
# fmt and Eigen. A set is compiled for a target of its own, which has no definitions but those of libraries.
function(hauberk_precompile target)
  if(NOT HAUBERK_PRECOMPILE)
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 1 arg "HIDDEN;JSON;TEST" "" "")
  string(JOIN _ set precompiled ${ARGN})
  string(TOLOWER "${set}" set)
  if(NOT TARGET ${set})
    set(empty "${PROJECT_BINARY_DIR}/precompiled/${set}.cpp")
    file(CONFIGURE OUTPUT "${empty}" CONTENT "int main() { return 0; }\n")
    if(arg_TEST)
      add_executable(${set} EXCLUDE_FROM_ALL "${empty}")
      target_compile_options(${set} PRIVATE "${HAUBERK_TEST_OPTIONS}")
    else()
      add_library(${set} STATIC EXCLUDE_FROM_ALL "${empty}")
    endif()
    target_link_libraries(${set} PRIVATE Eigen3::Eigen fmt::fmt hauberk_warnings $<$<BOOL:${arg_JSON}>:Boost::json>
                                         $<$<BOOL:${arg_TEST}>:GTest::gtest>)
    target_precompile_headers(${set} PRIVATE ${HAUBERK_PRECOMPILED} $<$<BOOL:${arg_JSON}>:<boost/json.hpp$<ANGLE-R>>
                                             $<$<BOOL:${arg_TEST}>:<gtest/gtest.h$<ANGLE-R>>)
    if(arg_HIDDEN)
      set_target_properties(${set} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
    endif()
  endif()
  target_precompile_headers(${target} REUSE_FROM ${set})
  # g++ 12 forgets which of them are headers of the system, and reports copies inside std::string that cannot happen.
  # Builds without precompiled headers keep these warnings.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow
                                             -Wno-stringop-overread)
  endif()
endfunction()

# hauberk_join(<target>): compiles sources six at a time. What most files take is templates of Eigen and Boost.JSON,
# which are made once for all six. Names in unnamed namespaces must differ within a target then; a file that cannot be
# joined has the property SKIP_UNITY_BUILD_INCLUSION. Off with a compiler cache, for the same reasons as above, and for
# work on a few files: -DHAUBERK_JOIN=OFF.
option(HAUBERK_JOIN "Compile several sources at a time" ${HAUBERK_PRECOMPILE_DEFAULT})
function(hauberk_join target)
  if(HAUBERK_JOIN)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
  endif()
endfunction()

# hauberk_join_folders(<target> <source>...): joins the sources of each folder instead, so that names in unnamed
# namespaces must differ within a folder only, whatever files others have.
function(hauberk_join_folders target)
  if(HAUBERK_JOIN)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    foreach(source IN LISTS ARGN)
      cmake_path(GET source PARENT_PATH folder)
      set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${folder}")
    endforeach()
  endif()
endfunction()
