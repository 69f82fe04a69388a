#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return culet::fuzz_reader(data, size,
                              [](std::string_view bytes) { return culet::parse_gcs(bytes).solid; });
}
