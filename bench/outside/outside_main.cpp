// Reads and fits designs, meshes and scans that others made.
//   bench_outside FOLDER [GoogleTest's options]
// FOLDER holds designs/*.asc, *.gem and metrics.json, meshes/*.stl, scans/*/polyhedron.dat.

#include <gtest/gtest.h>

#include <cstdio>

#include "bench/outside/outside_folder.h"

namespace culet::outside {
namespace {
std::filesystem::path k_folder;
}
const std::filesystem::path& folder() {
    return k_folder;
}
}  // namespace culet::outside

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    if (argc != 2 || !std::filesystem::is_directory(argv[1])) {
        std::fprintf(stderr, "usage: bench_outside FOLDER\n");
        return 2;
    }
    culet::outside::k_folder = argv[1];
    return RUN_ALL_TESTS();
}
