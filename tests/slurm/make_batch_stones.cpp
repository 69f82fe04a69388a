// Stone files as cutters bring them: make_batch_stones COUNT FOLDER writes stone-00001.toml with
// its mesh and an evening's readings, and so on. The same name always holds the same stone.

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "stone/stone.h"
#include "tests/fit/cutters.h"

namespace {

using namespace culet;
namespace fs = std::filesystem;

void write_stone(const fs::path& folder, int number) {
    constexpr const char* k_cuts[]{"round-brilliant", "oval", "cushion", "step"};
    constexpr const char* k_materials[]{"diamond", "sapphire_blue", "quartz", "spinel"};
    const std::string name = fmt::format("stone-{:05}", number);
    const bench::Evening evening =
        bench::cutters_evening(k_cuts[number % 4], {}, bench::Slipped::none, std::uint64_t(number));
    write_solid(evening.design.solid, folder / (name + ".obj"));
    std::ofstream readings(folder / (name + ".csv"));
    readings << "kind,of,value,sigma\n";
    for (const WrittenReading& row : evening.rows) {
        std::string of;
        for (const std::string& part : row.of) of += (of.empty() ? "" : "/") + part;
        readings << fmt::format("{},{},{},{}\n", row.kind, of, row.value.value_or(0),
                                row.sigma.value_or(0));
    }
    std::ofstream(folder / (name + ".toml")) << fmt::format(
        "[stone]\nname = \"{0}\"\nmesh = \"{0}.obj\"\nmaterial = \"{1}\"\nup = \"T\"\n"
        "azimuth_zero = \"mesh\"\nreadings = \"{0}.csv\"\n",
        name, k_materials[(number / 4) % 4]);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "make_batch_stones COUNT FOLDER\n");
        return 2;
    }
    fs::create_directories(argv[2]);
    for (int number = 1; number <= std::atoi(argv[1]); ++number) write_stone(argv[2], number);
    return 0;
}
