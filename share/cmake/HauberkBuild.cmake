# Settings every target of this project shares, and the target that carries our own warnings.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# One layout for the build tree and the installed tree, so that the program finds its plugins relative to
# itself in both: <root>/bin/hauberk, <root>/lib/libhauberk.so, <root>/lib/hauberk/plugins/<id>.so.
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib")
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib")
set(HAUBERK_PLUGIN_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib/hauberk/plugins")
set(CMAKE_INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_INSTALL_RPATH_USE_LINK_PATH ON)  # libraries of other prefixes
# What is installed is linked as it will be, where the layouts are one: CMake pads a path that it is to change at
# installation with colons, and the loader takes what is empty between them for the current directory.
if(CMAKE_INSTALL_LIBDIR STREQUAL "lib")
  set(HAUBERK_ONE_LAYOUT ON)
endif()

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE RelWithDebInfo CACHE STRING "Debug or RelWithDebInfo" FORCE)
endif()
# No -march=native: results should not depend on the machine that built the program. Never -ffast-math:
# the certificates rely on IEEE arithmetic. -g1 keeps line numbers in backtraces at little cost.
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O3 -g1 -DNDEBUG")

find_program(HAUBERK_CCACHE ccache)
mark_as_advanced(HAUBERK_CCACHE)
if(HAUBERK_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${HAUBERK_CCACHE}")
endif()

# Linked privately by our own targets only: plugins built elsewhere choose their own warnings.
add_library(hauberk_warnings INTERFACE)
target_compile_options(hauberk_warnings INTERFACE -Wall -Wextra $<$<BOOL:${HAUBERK_WERROR}>:-Werror>)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # g++ 12 reports overlapping copies inside std::string that cannot happen (GCC bug 105651).
  target_compile_options(hauberk_warnings INTERFACE -Wno-restrict)
endif()

if(HAUBERK_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "HAUBERK_FUZZ needs clang, which brings libFuzzer: -DCMAKE_CXX_COMPILER=clang++")
  endif()
  # Coverage for libFuzzer in every library; its main only in the harnesses (tests/fuzz).
  set(HAUBERK_SANITIZE "fuzzer-no-link,address,undefined")
endif()
if(HAUBERK_SANITIZE)
  # Errors must fail the tests, so nothing is recovered from.
  add_compile_options(-fsanitize=${HAUBERK_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${HAUBERK_SANITIZE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # g++ reports false positives from optimised std::string and Eigen code once sanitizers are on.
    target_compile_options(hauberk_warnings INTERFACE -Wno-maybe-uninitialized -Wno-stringop-overflow)
  endif()
endif()
if(HAUBERK_COVERAGE)
  add_compile_options(--coverage -fprofile-update=atomic)
  add_link_options(--coverage)
endif()

# Adds every folder below the current one that has a CMakeLists.txt, up to three levels down. A folder without one is
# looked into (tests/kernel/model is found although tests/kernel has none), one with one looks after what is below it
# itself; new folders are noticed by the next build.
function(hauberk_add_children)
  set(here "${CMAKE_CURRENT_SOURCE_DIR}")
  file(GLOB lists CONFIGURE_DEPENDS RELATIVE "${here}" "${here}/*/CMakeLists.txt" "${here}/*/*/CMakeLists.txt"
       "${here}/*/*/*/CMakeLists.txt")
  list(SORT lists)
  foreach(list IN LISTS lists)
    get_filename_component(folder "${list}" DIRECTORY)
    set(is_child TRUE)
    get_filename_component(above "${folder}" DIRECTORY)
    while(above)
      if(EXISTS "${here}/${above}/CMakeLists.txt")
        set(is_child FALSE)
      endif()
      get_filename_component(above "${above}" DIRECTORY)
    endwhile()
    if(is_child)
      add_subdirectory("${folder}")
    endif()
  endforeach()
endfunction()

# hauberk_absent_plugin(<id> <why>)
#
# For the folder of a plugin whose library is optional and was not found: says so, and lets tests of all plugins know
# (global property HAUBERK_ABSENT_PLUGINS).
function(hauberk_absent_plugin id why)
  message(STATUS "Plugin ${id} is not built: ${why}")
  set_property(GLOBAL APPEND PROPERTY HAUBERK_ABSENT_PLUGINS ${id})
endfunction()
