# `cmake --install build` and, from another project, find_package(culet) with the targets
# culet::stone, culet::page, culet::fit, culet::render, culet::viewer, culet::compare and culet::refine.
include(CMakePackageConfigHelpers)

# A package is made of what its workflow built, not of everything.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
install(TARGETS culet RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(TARGETS culet_stone culet_page culet_silhouettes culet_fit culet_render culet_viewer culet_compare culet_refine EXPORT culetTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library)
foreach(room stone page fit render viewer compare refine)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/culet COMPONENT library
    FILES_MATCHING PATTERN "*.h")
endforeach()
install(EXPORT culetTargets NAMESPACE culet:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/culet COMPONENT library)
configure_package_config_file(cmake/culetConfig.cmake.in ${CMAKE_BINARY_DIR}/culetConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/culet)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/culetConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/culetConfig.cmake ${CMAKE_BINARY_DIR}/culetConfigVersion.cmake
  ${CMAKE_SOURCE_DIR}/cmake/CuletDependencies.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/culet COMPONENT library)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/samples/batch DESTINATION ${CMAKE_INSTALL_DATADIR}/culet USE_SOURCE_PERMISSIONS
  COMPONENT program)
# A stone, its readings and a job, so that who has only the package has a first report.
install(DIRECTORY ${CMAKE_SOURCE_DIR}/samples/cutters-evening DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples COMPONENT program)
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

# `cmake --workflow --preset portable`: build/culet-VERSION-linux-ARCH.tar.gz, the program with its libraries, for other
# distributions than Debian 12.
set(portable ${CMAKE_BINARY_DIR}/portable/culet-${PROJECT_VERSION})
add_custom_target(portable VERBATIM
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${portable}
  COMMAND ${CMAKE_COMMAND} --install ${CMAKE_BINARY_DIR} --component program --strip --prefix ${portable}
  COMMAND sh ${CMAKE_SOURCE_DIR}/cmake/bundle_libraries.sh ${portable}/bin/culet ${portable}/lib/culet
  COMMAND ${CMAKE_COMMAND} -E chdir ${CMAKE_BINARY_DIR}/portable ${CMAKE_COMMAND} -E tar czf
    ${CMAKE_BINARY_DIR}/culet-${PROJECT_VERSION}-linux-${CMAKE_SYSTEM_PROCESSOR}.tar.gz culet-${PROJECT_VERSION})
add_dependencies(portable culet completion man engine)
