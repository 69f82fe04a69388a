# `cmake --workflow --preset deb`: build/culet_VERSION_ARCH.deb, for `apt install ./culet_*.deb`. It holds the program,
# its manual pages and completion, the engine of pages, and where it could be built the Python module; the library's headers are for `cmake --install`.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "The culet project")
set(CPACK_PACKAGE_CONTACT "culet <culet@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_THREADS 0)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME culet)
set(CPACK_DEBIAN_PROGRAM_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
# The names of Debian's library packages, read off the program.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# What the engine gpu opens when it is asked for.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libegl1, libgl1-mesa-dri")
if(CULET_MODULE_PYTHON)
  # Of its module; the program needs no Python.
  string(APPEND CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS ", python3, python3-numpy")
endif()
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS ffmpeg)
include(CPack)
