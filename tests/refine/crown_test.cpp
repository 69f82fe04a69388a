// Expectations: the edges of a stone that is given by its profile.

#include "refine/spin/crown.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "stone/numbers/units.h"

namespace culet {
namespace {

// Sides of a square stone 100 wide: the table's edge 30 from the axis, at height 40 + 0.1 x; a
// girdle edge further out and down; and two edges of refracted light that make no convex profile.
std::vector<std::vector<SurfaceEdge>> square_edges() {
    std::vector<std::vector<SurfaceEdge>> sides;
    for (int k = 0; k < 4; ++k) {
        const double azimuth = k * std::numbers::pi / 2, table = 40 + 1.5 * std::cos(azimuth);
        sides.push_back({{azimuth, 30, table, 5},
                         {azimuth, 20, 15, 4.5},
                         {azimuth, 48, 15, 4.2},
                         {azimuth, 34, 12, 3.5}});
    }
    return sides;
}

TEST(Crown, IsThePlanesThroughTheEdges) {
    const auto crown = crown_of(square_edges(), 100, 0.3);
    ASSERT_TRUE(crown);
    const Vec3 table = glm::normalize(Vec3(-0.05, 0, 1));
    EXPECT_LT(degrees(angle_between(crown->table.plane.normal, table)), 1e-6);
    EXPECT_NEAR(crown->table.plane.offset, 40 * table.z, 1e-9);
    ASSERT_EQ(crown->facets.size(), 4u);
    // From (30, 41.5) to (48, 15) along x.
    const Vec3 east = glm::normalize(Vec3(26.5, 0, 18));
    EXPECT_LT(degrees(angle_between(crown->facets[0].plane.normal, east)), 1e-6);
    EXPECT_NEAR(crown->facets[0].plane.offset, glm::dot(east, Vec3(48, 0, 15)), 1e-9);
    EXPECT_NEAR(crown->facets[0].tilt_sigma, 0.3 * std::sqrt(2.0) / std::hypot(18, 26.5), 1e-12);
}

TEST(Crown, NeedsATableOnFourSides) {
    auto sides = square_edges();
    sides.resize(3);
    EXPECT_FALSE(crown_of(sides, 100, 0.3));
    auto weak = square_edges();
    for (auto& side : weak) {
        for (SurfaceEdge& e : side) e.strength = 2.6;
    }
    EXPECT_FALSE(crown_of(weak, 100, 0.3));
}

}  // namespace
}  // namespace culet
