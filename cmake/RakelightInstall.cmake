# SPDX-FileCopyrightText: 2026 The Rakelight authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Program, libraries, headers and a package that find_package(rakelight) understands.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

get_property(RAKELIGHT_ROOMS GLOBAL PROPERTY RAKELIGHT_ROOMS)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/rakelight)

install(TARGETS rakelight RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
foreach(room IN LISTS RAKELIGHT_ROOMS)
  install(TARGETS rakelight_${room} EXPORT rakelightTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rakelight
    FILES_MATCHING PATTERN "*.h")
endforeach()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/rakelightConfig.cmake.in
  ${PROJECT_BINARY_DIR}/rakelightConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/rakelightConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(EXPORT rakelightTargets NAMESPACE rakelight:: DESTINATION ${package_dir})
install(FILES
  ${PROJECT_BINARY_DIR}/rakelightConfig.cmake ${PROJECT_BINARY_DIR}/rakelightConfigVersion.cmake
  ${CMAKE_CURRENT_LIST_DIR}/FindCHOLMOD.cmake DESTINATION ${package_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
