# culet_room(stone SOURCES a.cpp ... PUBLIC lower rooms ... PRIVATE heavy libraries ... PRECOMPILED <headers> ...)
# One library a room. PUBLIC shows only lower rooms and GLM; everything heavy stays PRIVATE.

add_library(culet_flags INTERFACE)
target_compile_options(culet_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror
  # g++ 12 sees overlapping copies in std::string's operator+ that are not there (its bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # With precompiled headers it reports in the standard library what it keeps to itself without them; the build
  # with sanitizers has none and keeps these warnings.
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<NOT:$<BOOL:${CMAKE_DISABLE_PRECOMPILE_HEADERS}>>>:-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread;-Wno-maybe-uninitialized;-Wno-nonnull>
  # One result on every machine: no fused multiply-add that the source does not ask for.
  $<$<NOT:$<BOOL:${CULET_CONTRACT}>>:-ffp-contract=off>)
if(CULET_CONTRACT)
  target_compile_options(culet_flags INTERFACE -ffp-contract=fast)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    # With AVX g++ 12 sees Eigen load four numbers from a vector of three, on a path for longer ones.
    target_compile_options(culet_flags INTERFACE -march=x86-64-v3
      $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds>)
  endif()
  target_compile_definitions(culet_flags INTERFACE HWY_COMPILE_ONLY_STATIC)
endif()
if(CULET_SANITIZE)
  target_compile_options(culet_flags INTERFACE -fsanitize=address,undefined
    -fno-sanitize-recover=undefined -fno-omit-frame-pointer
    # The checks that the sanitizers add make g++ warn of values that are never read.
    -Wno-maybe-uninitialized)
  target_link_options(culet_flags INTERFACE -fsanitize=address,undefined)
  # One instruction set is enough there: each takes minutes to compile with the sanitizers.
  target_compile_definitions(culet_flags INTERFACE HWY_COMPILE_ONLY_STATIC)
endif()

if(CULET_FUZZ)
  # Coverage for the fuzzers in tests/fuzz.
  target_compile_options(culet_flags INTERFACE -fsanitize=fuzzer-no-link,address,undefined
    -fno-sanitize-recover=undefined -Wno-error)
  target_compile_definitions(culet_flags INTERFACE HWY_COMPILE_ONLY_STATIC)
endif()

# g++ looks for garbage in its memory long before there is much: from 1 GB on it takes a tenth less time.
target_compile_options(culet_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1000000>)

# Most code is compiled at -O1, in half of the time that -O3 takes: a person waits for it no longer than a blink.
# What computes for longer is named in FAST of its room.
add_library(culet_seldom_run INTERFACE)
target_compile_options(culet_seldom_run INTERFACE $<$<CONFIG:Release>:-O1>)

# Reading these takes longer than compiling most files, so they are compiled once at each level of optimisation, for all
# rooms. Each file still includes what it uses: the build with sanitizers has no precompiled headers. Of Eigen, Core
# alone: a decomposition takes seconds in every unit that instantiates it (stone/numbers/dense_algebra.h).
set(CULET_PRECOMPILED
  <algorithm> <array> <chrono> <cmath> <complex> <filesystem> <functional> <limits> <map> <memory> <numbers>
  <numeric> <optional> <set> <span> <string> <string_view> <utility> <variant> <vector>
  <fmt/format.h> <glm/geometric.hpp> <glm/matrix.hpp> <nlohmann/json.hpp> <Eigen/Core>)
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/headers.cpp CONTENT "")
# culet_headers(name LINK further libraries ... FIRST further headers ...)
function(culet_headers name)
  cmake_parse_arguments(HEADERS "" "" "LINK;FIRST" ${ARGN})
  add_library(culet_headers_${name} OBJECT ${CMAKE_BINARY_DIR}/headers.cpp)
  target_link_libraries(culet_headers_${name} PRIVATE culet_flags ${HEADERS_LINK} fmt::fmt glm::glm Eigen3::Eigen
    nlohmann_json::nlohmann_json)
  target_precompile_headers(culet_headers_${name} PRIVATE ${HEADERS_FIRST} ${CULET_PRECOMPILED})
endfunction()
culet_headers(fast)
culet_headers(seldom_run LINK culet_seldom_run)
set_target_properties(culet_headers_fast culet_headers_seldom_run PROPERTIES POSITION_INDEPENDENT_CODE ON)

# culet_room(stone SOURCES a.cpp ... PUBLIC lower rooms ... PRIVATE heavy libraries ... FAST folders and files ...)
# One library a room. PUBLIC shows only lower rooms and GLM; everything heavy stays PRIVATE. What FAST names is compiled
# at -O3, the rest at -O1.
function(culet_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;PUBLIC;PRIVATE;FAST" ${ARGN})
  set(fast "")
  foreach(part ${ROOM_FAST})
    set(some ${ROOM_SOURCES})
    list(FILTER some INCLUDE REGEX "^${part}(/|$)")
    if(NOT some)
      message(FATAL_ERROR "culet_room(${name}): FAST names ${part}, which is no folder or file of it")
    endif()
    list(APPEND fast ${some})
  endforeach()
  set(seldom ${ROOM_SOURCES})
  list(REMOVE_ITEM seldom ${fast} "")
  add_library(culet_${name} STATIC ${seldom})
  add_library(culet::${name} ALIAS culet_${name})
  set_target_properties(culet_${name} PROPERTIES EXPORT_NAME ${name} CULET_SOURCES "${ROOM_SOURCES}")
  target_compile_features(culet_${name} PUBLIC cxx_std_20)
  target_include_directories(culet_${name} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/culet>)
  target_link_libraries(culet_${name} PUBLIC ${ROOM_PUBLIC} PRIVATE ${ROOM_PRIVATE}
    $<BUILD_INTERFACE:culet_flags> $<BUILD_INTERFACE:culet_seldom_run>)
  culet_compiled(culet_${name} seldom_run)
  if(fast)
    add_library(culet_${name}_fast OBJECT ${fast})
    target_include_directories(culet_${name}_fast PRIVATE ${CMAKE_SOURCE_DIR})
    target_link_libraries(culet_${name}_fast PRIVATE ${ROOM_PUBLIC} ${ROOM_PRIVATE} culet_flags)
    culet_compiled(culet_${name}_fast fast)
    target_sources(culet_${name} PRIVATE $<TARGET_OBJECTS:culet_${name}_fast>)
  endif()
endfunction()

# culet_compiled(target seldom_run|fast): with the precompiled headers of that level, several files at a time.
function(culet_compiled target level)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_precompile_headers(${target} REUSE_FROM culet_headers_${level})
  culet_unity(${target} 26)
endfunction()
