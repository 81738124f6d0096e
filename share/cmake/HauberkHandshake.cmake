# hauberk_handshake(<out> <folder>...)
#
# What a plugin of this project would say of its compiler, its standard library, Eigen and sanitizers (the handshake of
# hauberk/plugin.hpp, which lies in one of the folders), and whether its floating point is exact: a list of "name=text".
# It is what the preprocessor makes of the header with the flags, the build type and the options of the directory as they
# are now; those of a target, and of later lines, are not seen. Empty where the preprocessor cannot be asked.
function(hauberk_handshake out)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" config)
  separate_arguments(flags NATIVE_COMMAND
                     "${CMAKE_CXX_COMPILER_ARG1} ${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${config}}")
  get_directory_property(options COMPILE_OPTIONS)
  get_directory_property(definitions COMPILE_DEFINITIONS)
  list(TRANSFORM definitions PREPEND "-D")
  get_target_property(folders Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
  list(APPEND folders ${ARGN})
  list(TRANSFORM folders PREPEND "-I")
  set(arguments ${flags} ${options} ${definitions} ${folders})
  list(FILTER arguments EXCLUDE REGEX "\\$<")

  set(source "${CMAKE_BINARY_DIR}/CMakeFiles/hauberk_handshake.cpp")
  file(WRITE "${source}" "#include <hauberk/plugin.hpp>\n"
                         "hauberk_says compiler=HAUBERK_COMPILER\n"
                         "hauberk_says standard library=HAUBERK_STDLIB\n"
                         "hauberk_says Eigen=HAUBERK_EIGEN\n"
                         "hauberk_says Eigen alignment=HAUBERK_STR(EIGEN_MAX_ALIGN_BYTES)\n"
                         "hauberk_says sanitizers=HAUBERK_SANITIZERS\n"
                         "#ifdef __FAST_MATH__\n"
                         "hauberk_says floating point=\"inexact (-ffast-math)\"\n"
                         "#else\n"
                         "hauberk_says floating point=\"exact\"\n"
                         "#endif\n")
  execute_process(COMMAND "${CMAKE_CXX_COMPILER}" ${arguments} -std=c++20 -E -P -o "${source}.i" "${source}"
                  RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
  set(found "")
  if(NOT failed)
    file(STRINGS "${source}.i" found REGEX "^hauberk_says ")
    list(TRANSFORM found REPLACE "^hauberk_says " "")
    list(TRANSFORM found REPLACE "\" *\"" "")  # literals side by side are one
    list(TRANSFORM found REPLACE " *= *\"" "=")
    list(TRANSFORM found REPLACE "\"" "")
  endif()
  set(${out} "${found}" PARENT_SCOPE)
endfunction()

# hauberk_compare_handshake(<expected> <folder>...)
#
# Warns of what differs from the list that hauberk_handshake gave where Hauberk was built.
function(hauberk_compare_handshake expected)
  hauberk_handshake(found ${ARGN})
  set(differences "")
  foreach(mine theirs IN ZIP_LISTS found expected)
    if(mine AND theirs AND NOT mine STREQUAL theirs)
      string(REGEX MATCH "^([^=]*)=(.*)$" ignored "${theirs}")
      set(expected_text "${CMAKE_MATCH_2}")
      string(REGEX MATCH "^([^=]*)=(.*)$" ignored "${mine}")
      string(APPEND differences "\n  ${CMAKE_MATCH_1}: ${CMAKE_MATCH_2} (Hauberk: ${expected_text})")
    endif()
  endforeach()
  if(differences)
    message(WARNING "Hauberk was built otherwise than plugins of this project, and will refuse them:${differences}\n"
                    "Choose the compiler by -D CMAKE_CXX_COMPILER, and its flags and build type accordingly.")
  endif()
endfunction()
