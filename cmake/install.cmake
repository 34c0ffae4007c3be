# `cmake --install`: the command, and a package whose components are the libraries. A program that
# asks for `core` alone gets by with Eigen and Highway.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/beeline)

install(TARGETS beeline)
set_target_properties(beeline_beeline PROPERTIES EXPORT_NAME beeline)
install(TARGETS beeline_beeline EXPORT beeline-everything)
install(EXPORT beeline-everything NAMESPACE beeline:: DESTINATION ${package_dir})
foreach(component core batch reach io formula doctor draw)
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

install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES docs/arm.schema.json docs/scene.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/beeline)

# The manual page and the shell completions: the command prints them itself.
set(printed ${PROJECT_BINARY_DIR}/package)
install(CODE "
  function(print file)
    execute_process(COMMAND \"$<TARGET_FILE:beeline>\" \${ARGN}
      OUTPUT_FILE \"${printed}/\${file}\" COMMAND_ERROR_IS_FATAL ANY)
  endfunction()
  print(beeline.1 man)
  print(beeline completion bash)
  print(_beeline completion zsh)
  print(beeline.fish completion fish)")
install(FILES ${printed}/beeline.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${printed}/beeline DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${printed}/_beeline DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
install(FILES ${printed}/beeline.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

# The page, where `make web` has built it.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/build/web DESTINATION ${CMAKE_INSTALL_DATADIR}/beeline OPTIONAL)
