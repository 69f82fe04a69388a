#include "render/scene/scene_io.h"
#include "stone/cuts/cuts.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const culet::Stone stone = [] {
        culet::Stone made;
        made.solid = culet::make_cut("step");
        return made;
    }();
    return culet::fuzz_file(data, size, ".toml",
                            [](const auto& file) { culet::read_scene(file, {}, &stone); });
}
