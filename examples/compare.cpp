// Compares a photograph with a render of the same stone: compare PHOTO RENDER.exr
#include "compare/calibration/picture_comparison.h"

#include <cstdio>
#include <exception>

#include "compare/photo/photo.h"

int main(int argc, char** argv) try {
    using namespace culet;
    if (argc != 3) {
        std::fprintf(stderr, "usage: compare PHOTO RENDER\n");
        return 2;
    }
    const Photo photo = read_photo(argv[1]);
    const Photo render = read_photo(argv[2]);
    const Comparison comparison = compare(photo, render);

    std::printf("%s: %s\n", name_of(comparison.verdict), comparison.reason.c_str());
    for (const Score& score : comparison.scores) {
        if (!score.value) continue;  // not defined for these pictures
        std::printf("%-16s %9.4f   by chance %9.4f +- %.4f\n", score.key.c_str(), *score.value,
                    score.null_mean, score.null_sd);
    }
    return comparison.usable() ? 0 : 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
