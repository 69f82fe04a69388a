#include "render/image/image_io.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return culet::fuzz_file(data, size, ".picture",
                            [](const auto& file) { culet::read_picture(file); });
}
