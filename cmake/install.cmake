# SPDX-License-Identifier: GPL-3.0-or-later
# Installs component `host`: the tool, its models, and the package behind find_package(algest).
# Component `runtime` (headers and their own package) is installed by runtime/CMakeLists.txt.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_DATADIR}/cmake/algest)

configure_package_config_file(cmake/algestConfig.cmake.in algestConfig.cmake INSTALL_DESTINATION ${package_dir}
  PATH_VARS CMAKE_INSTALL_BINDIR)
write_basic_package_version_file(algestConfigVersion.cmake COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES ${PROJECT_BINARY_DIR}/algestConfig.cmake ${PROJECT_BINARY_DIR}/algestConfigVersion.cmake
  cmake/algest_add_estimator.cmake DESTINATION ${package_dir} COMPONENT host)
install(DIRECTORY models/ DESTINATION ${CMAKE_INSTALL_DATADIR}/algest/models COMPONENT host OPTIONAL FILES_MATCHING PATTERN *.toml)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT host)
if(TARGET algest)
  install(TARGETS algest RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT host)
endif()
