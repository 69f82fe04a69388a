# The engine that pages of the viewer carry, as CULET_VIEWER_ENGINE_SOURCE, a source file of it: built here
# where Emscripten is installed; else CULET_VIEWER_ENGINE, the file that a release was built with
# (share/culet/viewer-engine.wasm.gz); else none: pages then show a picture that does not turn.
set(CULET_VIEWER_ENGINE "" CACHE FILEPATH "viewer-engine.wasm.gz of a release, where this machine has no Emscripten")
find_program(CULET_EMXX em++)
find_file(CULET_EMSCRIPTEN_TOOLCHAIN Emscripten.cmake
  PATHS /usr/share/emscripten/cmake/Modules/Platform $ENV{EMSDK}/upstream/emscripten/cmake/Modules/Platform
  NO_DEFAULT_PATH)

set(engine_folder ${CMAKE_CURRENT_BINARY_DIR}/engine)
set(CULET_VIEWER_ENGINE_FILE ${CMAKE_CURRENT_BINARY_DIR}/viewer-engine.wasm.gz)
set(CULET_VIEWER_ENGINE_SOURCE ${CMAKE_CURRENT_BINARY_DIR}/viewer_engine_data.cpp)
set(embed ${CMAKE_SOURCE_DIR}/cmake/EmbedEngine.cmake)
set(CULET_HAS_VIEWER_ENGINE ON)
if(CULET_VIEWER_ENGINE)
  message(STATUS "viewer: the engine of pages is ${CULET_VIEWER_ENGINE}")
  add_custom_command(OUTPUT ${CULET_VIEWER_ENGINE_FILE}
    COMMAND ${CMAKE_COMMAND} -E copy ${CULET_VIEWER_ENGINE} ${CULET_VIEWER_ENGINE_FILE}
    DEPENDS ${CULET_VIEWER_ENGINE})
elseif(CULET_EMXX AND CULET_EMSCRIPTEN_TOOLCHAIN)
  # Where the headers of the libraries are that it shares with the program.
  foreach(name boost CGAL eigen3/Eigen fmt glm hwy nlohmann stb tinyexr.h toml++)
    string(MAKE_C_IDENTIFIER ${name} word)
    find_path(CULET_FOLDER_OF_${word} ${name} REQUIRED)
    list(APPEND header_folders ${CULET_FOLDER_OF_${word}})
  endforeach()
  list(REMOVE_DUPLICATES header_folders)
  list(JOIN header_folders "|" header_folders)
  include(ExternalProject)
  ExternalProject_Add(culet_viewer_engine
    SOURCE_DIR ${CMAKE_CURRENT_SOURCE_DIR}/wasm
    BINARY_DIR ${engine_folder}
    PREFIX ${CMAKE_CURRENT_BINARY_DIR}/engine-steps
    LIST_SEPARATOR |
    CMAKE_ARGS -DCMAKE_TOOLCHAIN_FILE=${CULET_EMSCRIPTEN_TOOLCHAIN} -DCMAKE_BUILD_TYPE=None
      -DCULET_HEADERS=${header_folders} -DCULET_VERSION=${PROJECT_VERSION} -DCULET_UNITY=${CULET_UNITY}
      -DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}
    INSTALL_COMMAND "" BUILD_ALWAYS ON BUILD_BYPRODUCTS ${engine_folder}/engine.wasm)
  # -n: no name and no time, so that the same engine is the same bytes.
  add_custom_command(OUTPUT ${CULET_VIEWER_ENGINE_FILE}
    COMMAND gzip -9nc ${engine_folder}/engine.wasm > ${CULET_VIEWER_ENGINE_FILE}
    DEPENDS culet_viewer_engine ${engine_folder}/engine.wasm)
else()
  message(STATUS "viewer: no Emscripten here: pages will not turn (docs/viewer.md: -DCULET_VIEWER_ENGINE=FILE)")
  set(CULET_HAS_VIEWER_ENGINE OFF)
endif()
if(CULET_HAS_VIEWER_ENGINE)
  add_custom_command(OUTPUT ${CULET_VIEWER_ENGINE_SOURCE}
    COMMAND base64 -w 0 ${CULET_VIEWER_ENGINE_FILE} > ${CULET_VIEWER_ENGINE_FILE}.base64
    COMMAND ${CMAKE_COMMAND} -DIN=${CULET_VIEWER_ENGINE_FILE}.base64 -DOUT=${CULET_VIEWER_ENGINE_SOURCE} -P ${embed}
    DEPENDS ${CULET_VIEWER_ENGINE_FILE} ${embed})
  install(FILES ${CULET_VIEWER_ENGINE_FILE} DESTINATION ${CMAKE_INSTALL_DATADIR}/culet COMPONENT program)
else()
  file(CONFIGURE OUTPUT ${CULET_VIEWER_ENGINE_SOURCE}
    CONTENT "namespace culet::embedded {\nextern const char* const viewer_engine;\nconst char* const viewer_engine = \"\";\n}\n")
endif()
set(CULET_HAS_VIEWER_ENGINE ${CULET_HAS_VIEWER_ENGINE} CACHE INTERNAL "")
set(CULET_VIEWER_ENGINE_FILE ${CULET_VIEWER_ENGINE_FILE} CACHE INTERNAL "")
