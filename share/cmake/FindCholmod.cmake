# Finds CHOLMOD and what it links (SuiteSparse 5.12 ships no CMake config). Defines SuiteSparse::cholmod.
find_path(Cholmod_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(Cholmod_LIBRARY cholmod)
find_library(Cholmod_CONFIG_LIBRARY suitesparseconfig)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  Cholmod
  REQUIRED_VARS Cholmod_LIBRARY Cholmod_CONFIG_LIBRARY Cholmod_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "install it with: apt-get install libsuitesparse-dev")
mark_as_advanced(Cholmod_INCLUDE_DIR Cholmod_LIBRARY Cholmod_CONFIG_LIBRARY)

if(Cholmod_FOUND AND NOT TARGET SuiteSparse::cholmod)
  # The shared library brings AMD, COLAMD and BLAS itself.
  add_library(SuiteSparse::cholmod UNKNOWN IMPORTED)
  set_target_properties(
    SuiteSparse::cholmod
    PROPERTIES IMPORTED_LOCATION "${Cholmod_LIBRARY}"
               INTERFACE_INCLUDE_DIRECTORIES "${Cholmod_INCLUDE_DIR}"
               INTERFACE_LINK_LIBRARIES "${Cholmod_CONFIG_LIBRARY}")
endif()
