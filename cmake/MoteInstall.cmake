# Installs the rooms so that an outside project does find_package(mote) and links mote::filter, mote::software, ...
include(CMakePackageConfigHelpers)
get_property(rooms GLOBAL PROPERTY MOTE_ROOMS)
install(TARGETS mote_arithmetic ${rooms} EXPORT mote_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT mote_targets NAMESPACE mote:: FILE moteTargets.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/mote)
configure_package_config_file(cmake/moteConfig.cmake.in ${PROJECT_BINARY_DIR}/moteConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/mote)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/moteConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/moteConfig.cmake ${PROJECT_BINARY_DIR}/moteConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/mote)
install(DIRECTORY papers data/platforms DESTINATION ${CMAKE_INSTALL_DATADIR}/mote)
