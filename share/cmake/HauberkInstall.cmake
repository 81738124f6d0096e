# Installs what plugins built elsewhere need: the kernel, the conformance kit, their headers, and a package that
# find_package(hauberk) understands. Commands, plugins and the template install themselves where they are defined.
include(CMakePackageConfigHelpers)

set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/hauberk")

set_target_properties(hauberk_host PROPERTIES EXPORT_NAME host)
set_target_properties(hauberk_fields PROPERTIES EXPORT_NAME fields)
set_target_properties(hauberk_conformance PROPERTIES EXPORT_NAME conformance)
install(TARGETS hauberk_kernel hauberk_host hauberk_fields hauberk_conformance EXPORT hauberkTargets)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/kernel/api/" "${PROJECT_BINARY_DIR}/kernel/api/"
                  "${PROJECT_SOURCE_DIR}/plugins/host/include/" "${PROJECT_SOURCE_DIR}/plugins/conformance/include/"
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(EXPORT hauberkTargets NAMESPACE hauberk:: DESTINATION "${package_folder}")

include(HauberkHandshake)
hauberk_handshake(HAUBERK_HANDSHAKE "${PROJECT_SOURCE_DIR}/kernel/api")
configure_package_config_file("${PROJECT_SOURCE_DIR}/share/cmake/hauberkConfig.cmake.in" hauberkConfig.cmake
                              INSTALL_DESTINATION "${package_folder}" PATH_VARS CMAKE_INSTALL_INCLUDEDIR)
# Before 1.0 every minor version may change the interfaces.
write_basic_package_version_file(hauberkConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/hauberkConfig.cmake"
              "${CMAKE_CURRENT_BINARY_DIR}/hauberkConfigVersion.cmake"
              "${PROJECT_SOURCE_DIR}/share/cmake/HauberkAddPlugin.cmake"
              "${PROJECT_SOURCE_DIR}/share/cmake/HauberkHandshake.cmake"
        DESTINATION "${package_folder}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/share/weaves/" DESTINATION "${CMAKE_INSTALL_DATADIR}/hauberk/weaves"
        FILES_MATCHING PATTERN "*.json")
install(FILES "${PROJECT_SOURCE_DIR}/share/web/page.html" DESTINATION "${CMAKE_INSTALL_DATADIR}/hauberk/web")
install(FILES "${PROJECT_SOURCE_DIR}/share/web/build/viewer.js" DESTINATION "${CMAKE_INSTALL_DATADIR}/hauberk/web" OPTIONAL)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/share/experiments/" DESTINATION "${CMAKE_INSTALL_DATADIR}/hauberk/experiments"
        FILES_MATCHING PATTERN "*.json")
install(FILES "${PROJECT_SOURCE_DIR}/share/schema/experiment.schema.json"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/hauberk/schema")
# Documents lie as in the sources, with the files that they link to, the experiments that they run, and the plugins
# as examples.
foreach(
  document
  README.md
  LICENSE
  CHANGELOG.md
  CITATION.cff
  CONTRIBUTING.md
  kernel/api/hauberk/shape.hpp
  kernel/api/hauberk/solid.hpp
  kernel/geometry/pair_frame.hpp
  share/cmake/FindPagmo.cmake
  share/doc
  share/experiments
  share/python/notebooks)
  get_filename_component(folder "${document}" DIRECTORY)
  if(IS_DIRECTORY "${PROJECT_SOURCE_DIR}/${document}")
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/${document}" DESTINATION "${CMAKE_INSTALL_DOCDIR}/${folder}")
  else()
    install(FILES "${PROJECT_SOURCE_DIR}/${document}" DESTINATION "${CMAKE_INSTALL_DOCDIR}/${folder}")
  endif()
endforeach()
install(DIRECTORY "${PROJECT_SOURCE_DIR}/shapes" "${PROJECT_SOURCE_DIR}/loadcases" "${PROJECT_SOURCE_DIR}/optimizers"
        DESTINATION "${CMAKE_INSTALL_DOCDIR}"
        PATTERN test EXCLUDE)

# cpack -G DEB: one package with the command, its plugins, and what plugins built elsewhere need.
set(CPACK_PACKAGE_NAME hauberk)
set(CPACK_PACKAGE_VENDOR Hauberk)
set(CPACK_PACKAGE_CONTACT "The Hauberk authors <hauberk@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
    "How far a chainmail-like fabric of linked rigid elements stretches, compresses and bends until contact locks it,
and element shapes that have the limits you want.")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${PROJECT_BINARY_DIR}/lib")
# Only to build plugins.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "g++, cmake, libeigen3-dev, libfmt-dev, libgtest-dev")
include(CPack)
