# Finds pagmo 2 and the Boost that it was built with. Defines Pagmo::pagmo.
#
# On Debian 12 the headers of pagmo need those of Boost 1.74, which cannot be installed beside the 1.81 that the rest is
# built with. `share/setup.sh --optional` unpacks both into build/pagmo, where nothing else sees them; the libraries
# are those of the system. pagmo's own CMake package would look for Boost once more and find the wrong one.
find_path(Pagmo_INCLUDE_DIR pagmo/pagmo.hpp HINTS "${PROJECT_SOURCE_DIR}/build/pagmo/usr/include")
find_library(Pagmo_LIBRARY NAMES pagmo libpagmo.so.8)

# The Boost whose headers lie beside pagmo's.
set(boost_libraries boost_serialization)
if(Pagmo_INCLUDE_DIR AND EXISTS "${Pagmo_INCLUDE_DIR}/boost/version.hpp")
  file(STRINGS "${Pagmo_INCLUDE_DIR}/boost/version.hpp" boost_version REGEX "^#define BOOST_VERSION [0-9]+")
  string(REGEX REPLACE "[^0-9]*([0-9]+)([0-9][0-9][0-9])([0-9][0-9]).*" "\\1.\\2.\\3" boost_version "${boost_version}")
  string(REGEX REPLACE "\\.0+([0-9])" ".\\1" boost_version "${boost_version}")
  set(boost_libraries libboost_serialization.so.${boost_version} boost_serialization)
endif()
find_library(Pagmo_BOOST_LIBRARY NAMES ${boost_libraries})

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Pagmo REQUIRED_VARS Pagmo_LIBRARY Pagmo_BOOST_LIBRARY Pagmo_INCLUDE_DIR)
mark_as_advanced(Pagmo_INCLUDE_DIR Pagmo_LIBRARY Pagmo_BOOST_LIBRARY)

if(Pagmo_FOUND AND NOT TARGET Pagmo::pagmo)
  add_library(Pagmo::pagmo UNKNOWN IMPORTED)
  set_target_properties(
    Pagmo::pagmo
    PROPERTIES IMPORTED_LOCATION "${Pagmo_LIBRARY}"
               INTERFACE_INCLUDE_DIRECTORIES "${Pagmo_INCLUDE_DIR}"
               INTERFACE_LINK_LIBRARIES "${Pagmo_BOOST_LIBRARY}")
endif()
