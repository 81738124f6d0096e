# Installs what plugins built elsewhere need: the kernel, its headers, and a package that find_package(hauberk)
# understands. Commands and plugins install themselves where they are defined.
include(CMakePackageConfigHelpers)

set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/hauberk")

install(TARGETS hauberk_kernel EXPORT hauberkTargets)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/kernel/include/" "${PROJECT_BINARY_DIR}/kernel/include/"
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(EXPORT hauberkTargets NAMESPACE hauberk:: DESTINATION "${package_folder}")

configure_package_config_file("${PROJECT_SOURCE_DIR}/share/cmake/hauberkConfig.cmake.in" hauberkConfig.cmake
                              INSTALL_DESTINATION "${package_folder}")
# Before 1.0 every minor version may change the interfaces.
write_basic_package_version_file(hauberkConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/hauberkConfig.cmake"
              "${CMAKE_CURRENT_BINARY_DIR}/hauberkConfigVersion.cmake"
              "${PROJECT_SOURCE_DIR}/share/cmake/HauberkAddPlugin.cmake"
        DESTINATION "${package_folder}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/share/weaves/" DESTINATION "${CMAKE_INSTALL_DATADIR}/hauberk/weaves"
        FILES_MATCHING PATTERN "*.json")
