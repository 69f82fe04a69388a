# `cmake --install build` and, from another project, find_package(culet) with the targets
# culet::stone, culet::page, culet::fit, culet::render, culet::viewer, culet::compare and culet::refine.
include(CMakePackageConfigHelpers)

# A package is made of what its workflow built, not of everything.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
install(TARGETS culet RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(TARGETS culet_stone culet_page culet_silhouettes culet_fit culet_render culet_viewer culet_compare culet_refine EXPORT culetTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
foreach(room stone page fit render viewer compare refine)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/culet
    FILES_MATCHING PATTERN "*.h")
endforeach()
install(EXPORT culetTargets NAMESPACE culet:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/culet)
configure_package_config_file(cmake/culetConfig.cmake.in ${CMAKE_BINARY_DIR}/culetConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/culet)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/culetConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/culetConfig.cmake ${CMAKE_BINARY_DIR}/culetConfigVersion.cmake
  ${CMAKE_SOURCE_DIR}/cmake/CuletDependencies.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/culet)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/samples/batch DESTINATION ${CMAKE_INSTALL_DATADIR}/culet USE_SOURCE_PERMISSIONS
  COMPONENT program)
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
