# The target `engine`: share/culet/engine.wasm in the build folder, the engine that pages of culet view carry, where
# Emscripten is installed (.ci/packages-engine.txt). The program reads the file when it writes a page. It is part of a
# whole build and of the package, not of the target culet: the first command need not wait for it.
find_program(CULET_EMXX em++)
find_file(CULET_EMSCRIPTEN_TOOLCHAIN Emscripten.cmake
  PATHS /usr/share/emscripten/cmake/Modules/Platform $ENV{EMSDK}/upstream/emscripten/cmake/Modules/Platform
  NO_DEFAULT_PATH)

set(CULET_VIEWER_ENGINE_FILE ${CMAKE_BINARY_DIR}/share/culet/engine.wasm)
if(CULET_EMXX AND CULET_EMSCRIPTEN_TOOLCHAIN)
  set(CULET_HAS_VIEWER_ENGINE ON)
  # Where the headers of the libraries are that it shares with the program.
  foreach(name boost CGAL eigen3/Eigen fmt glm hwy nlohmann stb tinyexr.h toml++)
    string(MAKE_C_IDENTIFIER ${name} word)
    find_path(CULET_FOLDER_OF_${word} ${name} REQUIRED)
    list(APPEND header_folders ${CULET_FOLDER_OF_${word}})
  endforeach()
  list(REMOVE_DUPLICATES header_folders)
  list(JOIN header_folders "|" header_folders)
  set(engine_folder ${CMAKE_CURRENT_BINARY_DIR}/engine)
  include(ExternalProject)
  ExternalProject_Add(culet_viewer_engine
    SOURCE_DIR ${CMAKE_CURRENT_SOURCE_DIR}/wasm
    BINARY_DIR ${engine_folder}
    PREFIX ${CMAKE_CURRENT_BINARY_DIR}/engine-steps
    LIST_SEPARATOR |
    CMAKE_ARGS -DCMAKE_TOOLCHAIN_FILE=${CULET_EMSCRIPTEN_TOOLCHAIN} -DCMAKE_BUILD_TYPE=None
      -DCULET_HEADERS=${header_folders} -DCULET_VERSION=${PROJECT_VERSION} -DCULET_UNITY=${CULET_UNITY}
      -DCULET_JOBS=${CULET_JOBS} -DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}
    INSTALL_COMMAND "" BUILD_ALWAYS ON EXCLUDE_FROM_ALL ON USES_TERMINAL_BUILD ON
    BUILD_BYPRODUCTS ${engine_folder}/engine.wasm)
  add_custom_command(OUTPUT ${CULET_VIEWER_ENGINE_FILE}
    COMMAND ${CMAKE_COMMAND} -E copy ${engine_folder}/engine.wasm ${CULET_VIEWER_ENGINE_FILE}
    DEPENDS culet_viewer_engine ${engine_folder}/engine.wasm)
  add_custom_target(engine ALL DEPENDS ${CULET_VIEWER_ENGINE_FILE})
else()
  set(CULET_HAS_VIEWER_ENGINE OFF)
  message(STATUS "No engine for pages: it needs the packages of .ci/packages-engine.txt; sh viewer/engine.sh installs them")
  add_custom_target(engine)
endif()
install(FILES ${CULET_VIEWER_ENGINE_FILE} DESTINATION ${CMAKE_INSTALL_DATADIR}/culet COMPONENT program OPTIONAL)
set(CULET_HAS_VIEWER_ENGINE ${CULET_HAS_VIEWER_ENGINE} CACHE INTERNAL "")
set(CULET_VIEWER_ENGINE_FILE ${CULET_VIEWER_ENGINE_FILE} CACHE INTERNAL "")
