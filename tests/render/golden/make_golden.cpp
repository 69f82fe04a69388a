// Redraws the pictures that golden_test.cpp compares with. Look at them before they are committed.
// Arguments: only these scenes.

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "tests/render/golden/golden_picture.h"

int main(int argc, char** argv) {
    using namespace culet::test;
    constexpr std::uint64_t k_pictures = 16, k_first_seed = 101;
    for (const std::string& scene : golden_scenes()) {
        const bool named = std::find(argv + 1, argv + argc, scene) != argv + argc;
        if (argc > 1 && !named) continue;
        for (const char* engine : {"auto", "reference"}) {
            std::vector<culet::Picture> pictures;
            for (std::uint64_t k = 0; k < k_pictures; ++k)
                pictures.push_back(drawn(scene, engine, k_first_seed + k));
            const GoldenPicture golden = golden_of(pictures);
            write_golden(golden, golden_file(scene, engine));
            fmt::print("{} by {}: ratio {:.3f} +- {:.3f}\n", scene, engine, golden.ratio_mean,
                       golden.ratio_sigma);
        }
    }
}
