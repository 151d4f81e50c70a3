# SPDX-FileCopyrightText: 2026 The Rakelight authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# OpenNI2 looks for drivers beside the name it was loaded by, links not resolved. So a folder of our own with a link to the
# library, links to the drivers of the system and our virtual sensor gives the program all of them, without root:
#   RAKELIGHT_OPENNI_DIR in the build tree, RAKELIGHT_OPENNI_INSTALL_DIR below the prefix.
# rakelight_find_openni(TARGET) makes a program load the library from there.
include(GNUInstallDirs)
set(RAKELIGHT_OPENNI_DIR ${PROJECT_BINARY_DIR}/lib)
set(RAKELIGHT_OPENNI_INSTALL_DIR ${CMAKE_INSTALL_LIBDIR}/rakelight)

function(rakelight_link_openni)
  find_library(RAKELIGHT_OPENNI_LIBRARY libOpenNI2.so.0 REQUIRED)
  mark_as_advanced(RAKELIGHT_OPENNI_LIBRARY)
  cmake_path(GET RAKELIGHT_OPENNI_LIBRARY PARENT_PATH system_dir)
  file(GLOB drivers ${system_dir}/OpenNI2/Drivers/lib*.so.0)
  list(FILTER drivers EXCLUDE REGEX libDummyDevice)  # it announces a device that is none
  file(MAKE_DIRECTORY ${RAKELIGHT_OPENNI_DIR}/OpenNI2/Drivers)
  file(CREATE_LINK ${RAKELIGHT_OPENNI_LIBRARY} ${RAKELIGHT_OPENNI_DIR}/libOpenNI2.so.0 SYMBOLIC)
  install(FILES ${RAKELIGHT_OPENNI_DIR}/libOpenNI2.so.0 DESTINATION ${RAKELIGHT_OPENNI_INSTALL_DIR})
  foreach(driver IN LISTS drivers)
    cmake_path(GET driver FILENAME name)
    file(CREATE_LINK ${driver} ${RAKELIGHT_OPENNI_DIR}/OpenNI2/Drivers/${name} SYMBOLIC)
    install(FILES ${RAKELIGHT_OPENNI_DIR}/OpenNI2/Drivers/${name}
      DESTINATION ${RAKELIGHT_OPENNI_INSTALL_DIR}/OpenNI2/Drivers)
  endforeach()
endfunction()

function(rakelight_find_openni target)
  file(RELATIVE_PATH from_bin /${CMAKE_INSTALL_BINDIR} /${RAKELIGHT_OPENNI_INSTALL_DIR})
  set_target_properties(${target} PROPERTIES
    BUILD_RPATH ${RAKELIGHT_OPENNI_DIR} INSTALL_RPATH $ORIGIN/${from_bin})
endfunction()
