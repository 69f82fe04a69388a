#include "stone/stone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "stone/design/proportions.h"
#include "stone/solid/checks.h"
#include "stone/text/errors.h"
#include "tests/scratch_folder.h"
#include "tests/stone/synthetic_solids.h"

namespace culet {
namespace {

using namespace culet::test;
constexpr double pi = std::numbers::pi;

TEST(Inclination, IsZeroForTableAndCuletAndAQuarterForTheGirdle) {
    EXPECT_EQ(inclination({0, 0, 1}, {0, 0, 1}), 0);
    EXPECT_EQ(inclination({0, 0, -1}, {0, 0, 1}), 0);
    EXPECT_DOUBLE_EQ(inclination({1, 0, 0}, {0, 0, 1}), pi / 2);
    EXPECT_DOUBLE_EQ(inclination({0, 0.6, -0.8}, {0, 0, 1}), std::asin(0.6));
    // A tilt of 1e-12 keeps all its digits.
    EXPECT_DOUBLE_EQ(inclination({1e-12, 0, 1}, {0, 0, 1}), 1e-12);
}

TEST(Azimuth, CountsCounterClockwiseFromXInOneTurn) {
    EXPECT_EQ(azimuth({1, 0, 0}), 0);
    EXPECT_DOUBLE_EQ(azimuth({0, 1, 0}), pi / 2);
    EXPECT_DOUBLE_EQ(azimuth({-1, 0, 0.5}), pi);
    EXPECT_DOUBLE_EQ(azimuth({0, -1, 0}), 3 * pi / 2);
    EXPECT_LT(azimuth({1, -1e-300, 0}), 2 * pi);
    EXPECT_FALSE(std::signbit(azimuth({1, -0.0, 0})));  // shown as 0, not as -0
}

TEST(ReadSolid, GoesByExtensionWhateverItsCase) {
    const ScratchFolder folder;
    for (const char* name : {"a.obj", "b.OFF", "c.Ply", "d.stl", "e.asc"}) {
        write_solid(cube(), folder / name);
        EXPECT_TRUE(find_faults(read_solid(folder / name).solid).empty()) << name;
    }
    EXPECT_THROW(read_solid(folder / "a.3ds"), InputError);
    EXPECT_THROW(write_solid(cube(), folder / "a.glb"), InputError);
    EXPECT_THROW(write_solid(cube(), folder / "a"), InputError);
}

// A prism of 2 x 3 with a crown of 45 degrees up to a table of 1 x 2, and a roof below.
TEST(Proportions, AreThoseOfABlock) {
    const double c = std::sqrt(0.5);
    std::vector<NamedPlane> planes{
        {"g0", {{1, 0, 0}, 1}},         {"g1", {{-1, 0, 0}, 1}},        {"g2", {{0, 1, 0}, 1.5}},
        {"g3", {{0, -1, 0}, 1.5}},      {"c0", {{c, 0, c}, c}},         {"c1", {{-c, 0, c}, c}},
        {"c2", {{0, c, c}, 1.5 * c}},   {"c3", {{0, -c, c}, 1.5 * c}},  {"t", {{0, 0, 1}, 0.5}},
        {"p0", {{c, 0, -c}, 1.25 * c}}, {"p1", {{-c, 0, -c}, 1.25 * c}}};
    const Proportions p = proportions(intersect_half_spaces(planes).solid);
    EXPECT_DOUBLE_EQ(p.width, 2);
    EXPECT_DOUBLE_EQ(p.length, 3);
    EXPECT_DOUBLE_EQ(p.table_width.value(), 1);
    EXPECT_DOUBLE_EQ(p.table_length.value(), 2);
    EXPECT_DOUBLE_EQ(p.crown, 0.5);
    EXPECT_DOUBLE_EQ(p.pavilion, 1);
    EXPECT_DOUBLE_EQ(p.height, 1.75);
}

}  // namespace
}  // namespace culet
