# The site: pages and the reference of the library by Doxygen, into build/docs/site. A build of its own
# (cmake --workflow --preset docs), so that nothing need be compiled or found for it but Doxygen.
find_program(CULET_DOXYGEN doxygen)
find_program(CULET_DOT dot)
if(NOT CULET_DOXYGEN OR NOT CULET_DOT)
  message(FATAL_ERROR "The site needs Debian's doxygen and graphviz: "
    "sh .ci/install-packages.sh .ci/packages-dev.txt")
endif()
add_custom_target(docs ALL
  COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_SOURCE_DIR}/build/docs
  COMMAND ${CULET_DOXYGEN} docs/site/Doxyfile
  COMMAND ${CMAKE_COMMAND} -E copy_directory docs/sources build/docs/site/sources
  COMMAND ${CMAKE_COMMAND} -E echo "Site: ${CMAKE_SOURCE_DIR}/build/docs/site/index.html"
  WORKING_DIRECTORY ${CMAKE_SOURCE_DIR} VERBATIM)
