# `cmake --install`: the command, and a package whose components are the libraries. A program that
# asks for `core` alone gets by with Eigen and Highway.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/beeline)

install(TARGETS beeline)
set_target_properties(beeline_beeline PROPERTIES EXPORT_NAME beeline)
install(TARGETS beeline_beeline EXPORT beeline-everything)
install(EXPORT beeline-everything NAMESPACE beeline:: DESTINATION ${package_dir})
foreach(component core batch read draw)
  install(TARGETS beeline_${component} EXPORT beeline-${component} FILE_SET HEADERS)
  install(EXPORT beeline-${component} NAMESPACE beeline:: DESTINATION ${package_dir})
endforeach()

configure_package_config_file(cmake/beeline-config.cmake.in
  ${PROJECT_BINARY_DIR}/package/beeline-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/beeline-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/package/beeline-config.cmake
  ${PROJECT_BINARY_DIR}/package/beeline-config-version.cmake
  DESTINATION ${package_dir})
