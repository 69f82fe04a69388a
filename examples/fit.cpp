// Fits a stone to its readings and prints the angle of every facet: fit STONE.toml FITTED.obj
#include <cstdio>
#include <exception>

#include "fit/fit.h"
#include "stone/stone_io.h"

int main(int argc, char** argv) try {
    using namespace culet;
    if (argc != 3) {
        std::fprintf(stderr, "usage: fit STONE.toml FITTED.obj\n");
        return 2;
    }
    const StoneFile file = read_stone(argv[1]);
    const FitInput input = fit_input(file.stone, read_readings(argv[1]));
    const FitResult result = fit_stone(input, read_fit_options(argv[1]));

    std::printf("%s: %s\n", name_of(result.status), result.message.c_str());
    for (const FittedFacet& facet : result.facets) {  // angles are radians inside
        std::printf("%-6s %8.3f +- %.3f degrees\n", facet.name.c_str(), degrees(facet.inclination),
                    degrees(facet.sigma_inclination));
    }
    if (!result.solid.facets.empty()) write_solid(result.solid, argv[2]);
    return result.usable() ? 0 : 1;
} catch (const std::exception& error) {  // culet::InputError says what is wrong with a file
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
