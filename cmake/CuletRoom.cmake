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

# Code that a person waits for no longer than a blink: at -O1 it compiles in two thirds of the time.
add_library(culet_seldom_run INTERFACE)
target_compile_options(culet_seldom_run INTERFACE $<$<CONFIG:Release>:-O1>)

# Reading these takes longer than compiling most files. Each file still includes what it uses: the build with
# sanitizers has no precompiled headers.
set(CULET_PRECOMPILED
  <algorithm> <array> <chrono> <cmath> <complex> <filesystem> <functional> <limits> <map> <memory> <numbers>
  <numeric> <optional> <set> <span> <string> <string_view> <utility> <variant> <vector>
  <fmt/format.h> <glm/geometric.hpp> <glm/matrix.hpp>)

function(culet_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;PUBLIC;PRIVATE;PRECOMPILED" ${ARGN})
  add_library(culet_${name} STATIC ${ROOM_SOURCES})
  add_library(culet::${name} ALIAS culet_${name})
  set_target_properties(culet_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(culet_${name} PUBLIC cxx_std_20)
  target_include_directories(culet_${name} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/culet>)
  target_link_libraries(culet_${name} PUBLIC ${ROOM_PUBLIC} PRIVATE ${ROOM_PRIVATE}
    $<BUILD_INTERFACE:culet_flags>)
  target_precompile_headers(culet_${name} PRIVATE ${CULET_PRECOMPILED} ${ROOM_PRECOMPILED})
  culet_unity(culet_${name})
endfunction()
