# `cmake --workflow --preset deb`: build/culet_VERSION_ARCH.deb, for `apt install ./culet_*.deb`, with the program, its
# manual pages and completion, the engine of pages, and where it could be built the Python module; and
# build/libculet-dev_VERSION_ARCH.deb, the static libraries of the rooms with their headers, for find_package(culet).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "The culet project")
# No address: reports go where the package came from (SECURITY.md).
set(CPACK_PACKAGE_CONTACT "The culet authors <culet@example.org>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_THREADS 0)
set(CPACK_COMPONENTS_ALL program library)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "model of a real cut gemstone, from its measurements")
set(about "culet fits a drawn mesh to readings of calipers, goniometer and\nscale, says how sure it is of every facet, draws the stone with\npolarised light, and compares the picture with a photograph.")

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME culet)
set(CPACK_DEBIAN_PROGRAM_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "${about}")
# The names of Debian's library packages, read off the program.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# What the engine gpu opens when it is asked for.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libegl1, libgl1-mesa-dri")
if(CULET_MODULE_PYTHON)
  # Of its module; the program needs no Python.
  string(APPEND CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS ", python3, python3-numpy")
endif()
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS ffmpeg)

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libculet-dev)
set(CPACK_DEBIAN_LIBRARY_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "${about}\nThese are its static libraries, with headers and a CMake package.")
# What find_package(culet) looks for: what culet is built from, but for tools and what the program alone uses.
file(STRINGS ${CMAKE_SOURCE_DIR}/.ci/packages.txt needed REGEX "^(lib|nlohmann|pkg-config|zlib)")
list(FILTER needed EXCLUDE REGEX "^lib(cpp-httplib|egl|gles)-dev$")
if(CULET_WITH_OPEN_CASCADE)
  list(APPEND needed libocct-data-exchange-dev)
endif()
list(JOIN needed ", " CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS)

# Debian's own files of both packages.
file(READ ${CMAKE_SOURCE_DIR}/LICENSE licence)
string(REGEX REPLACE "^MIT License\n+Copyright[^\n]*\n+" "" licence "${licence}")
string(STRIP "${licence}" licence)
string(REPLACE "\n\n" "\n.\n" licence "${licence}")
string(REPLACE "\n" "\n " licence "${licence}")
execute_process(COMMAND sed -n "s/^date-released: //p" ${CMAKE_SOURCE_DIR}/CITATION.cff OUTPUT_VARIABLE released)
execute_process(COMMAND date -R -u -d "${released}" OUTPUT_VARIABLE released OUTPUT_STRIP_TRAILING_WHITESPACE)
foreach(file copyright changelog)
  configure_file(${CMAKE_SOURCE_DIR}/cmake/debian/${file}.in ${CMAKE_BINARY_DIR}/debian/${file} @ONLY)
endforeach()
execute_process(COMMAND gzip -9nf ${CMAKE_BINARY_DIR}/debian/changelog)
foreach(component_folder program/culet library/libculet-dev)
  get_filename_component(component ${component_folder} DIRECTORY)
  get_filename_component(folder ${component_folder} NAME)
  install(FILES ${CMAKE_BINARY_DIR}/debian/copyright ${CMAKE_BINARY_DIR}/debian/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${folder} COMPONENT ${component})
endforeach()
include(CPack)
