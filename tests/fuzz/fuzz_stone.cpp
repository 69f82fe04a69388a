// A stone file: [stone], [material], [[reading]] and [fit]. Its mesh does not exist, so this tests
// what is read before the mesh; the readings are read separately.

#include "fit/fit.h"
#include "fit/readings/measurement.h"
#include "stone/stone_io.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    culet::fuzz_file(data, size, ".toml", [](const auto& file) { culet::read_readings(file); });
    culet::fuzz_file(data, size, ".toml", [](const auto& file) { culet::read_fit_options(file); });
    return culet::fuzz_file(data, size, ".toml", [](const auto& file) { culet::read_stone(file); });
}
