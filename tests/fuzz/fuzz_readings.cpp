#include "fit/readings/measurement.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return culet::fuzz_file(data, size, ".csv",
                            [](const auto& file) { culet::read_readings_csv(file); });
}
