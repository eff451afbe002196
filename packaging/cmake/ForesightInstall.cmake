# cmake --install build/release --prefix P puts the programs, their libraries, scenes and the head's service below P;
# `cpack` in the build folder makes a Debian package of the same (docs/user-guide, "On the robot").
include(GNUInstallDirs)
set(programs foresightctl foresight-head)
if(FORESIGHT_BUILD_GUI)
  list(APPEND programs foresight_gui)
endif()
set(libraries foresight_core foresight_simulation foresight_evaluation foresight_exchange foresight_mapping
  foresight_hardware foresight_emulator foresight_link foresightctl_late)
# Our own libraries are nobody else's: they lie in a folder of their own.
set(library_folder ${CMAKE_INSTALL_LIBDIR}/foresight)
file(RELATIVE_PATH from_programs /${CMAKE_INSTALL_BINDIR} /${library_folder})
set_target_properties(${programs} PROPERTIES INSTALL_RPATH "$ORIGIN/${from_programs}")
set_target_properties(${libraries} PROPERTIES INSTALL_RPATH "$ORIGIN")
install(TARGETS ${programs} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS ${libraries} LIBRARY DESTINATION ${library_folder} NAMELINK_SKIP)
install(DIRECTORY resources/scenes resources/rigs resources/heads DESTINATION ${CMAKE_INSTALL_DATADIR}/foresight)
install(FILES packaging/head/foresight-head.service DESTINATION lib/systemd/system)
install(FILES packaging/head/foresight.conf DESTINATION lib/sysusers.d)
if(FORESIGHT_BUILD_GUI)
  install(FILES packaging/foresight.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
  install(FILES resources/icons/valve.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps
    RENAME foresight.svg)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME foresight)
set(CPACK_PACKAGE_CONTACT "The Foresight project")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Operator workstation for a rotating lidar-camera sensor head")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
# Loaded without being linked: icons, fonts, OpenGL.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libqt5svg5, fonts-dejavu-core, libgl1-mesa-dri")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_SOURCE_DIR}/packaging/head/postinst)
set(CPACK_STRIP_FILES ON)
include(CPack)
