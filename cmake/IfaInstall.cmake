# SPDX-License-Identifier: Apache-2.0
# What `cmake --install` puts where, and the package file for find_package(InverseFoley).
include(CMakePackageConfigHelpers)

install(TARGETS ifa_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
set_target_properties(ifa PROPERTIES OUTPUT_NAME inverse-foley)
install(TARGETS ifa EXPORT InverseFoleyTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/ifa DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/objects/
        DESTINATION ${CMAKE_INSTALL_DATADIR}/inverse-foley/objects
        FILES_MATCHING PATTERN "*.json" PATTERN "*.obj" PATTERN "*.mtl")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(IFA_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/InverseFoley)
set(IFA_OBJECTS_DIR ${CMAKE_INSTALL_DATADIR}/inverse-foley/objects)
configure_package_config_file(
  ${CMAKE_CURRENT_LIST_DIR}/InverseFoleyConfig.cmake.in
  ${PROJECT_BINARY_DIR}/InverseFoleyConfig.cmake
  INSTALL_DESTINATION ${IFA_PACKAGE_DIR} PATH_VARS IFA_OBJECTS_DIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/InverseFoleyConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/InverseFoleyConfig.cmake
              ${PROJECT_BINARY_DIR}/InverseFoleyConfigVersion.cmake
        DESTINATION ${IFA_PACKAGE_DIR})
install(EXPORT InverseFoleyTargets NAMESPACE InverseFoley:: DESTINATION ${IFA_PACKAGE_DIR})
