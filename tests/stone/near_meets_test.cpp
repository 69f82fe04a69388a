#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "stone/solid/checks.h"
#include "stone/solid/solid.h"
#include "tests/stone/synthetic_solids.h"

namespace culet {
namespace {

using namespace culet::test;

Solid shaken_octahedron(double miss, std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    std::uniform_real_distribution<double> shift(-miss, miss);
    auto planes = octahedron_planes();
    for (NamedPlane& p : planes) p.plane.offset += shift(generator);
    return intersect_half_spaces(planes).solid;
}

TEST(NearMeets, ShakenOctahedronKeepsItsSixCorners) {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        SCOPED_TRACE(seed);
        const Solid raw = shaken_octahedron(1e-5, seed);
        EXPECT_GT(raw.vertices.size(), 6u);
        const ContractedSolid joined = contract_near_meets(raw, 3e-4);
        EXPECT_EQ(joined.solid.vertices.size(), 6u);
        EXPECT_EQ(joined.solid.facets.size(), 8u);
        EXPECT_TRUE(joined.vanished.empty());
        EXPECT_TRUE(is_closed(joined.solid));
        // Four planes shifted by 1e-5 miss their least-squares meet by no more than that.
        EXPECT_LT(planarity(joined.solid), 1e-5);
        EXPECT_TRUE(is_convex(joined.solid));
    }
}

TEST(NearMeets, PlanesStayAsTheyAre) {
    const Solid raw = shaken_octahedron(1e-5, 2);
    EXPECT_EQ(plane_difference(raw, contract_near_meets(raw, 3e-4).solid), 0);
}

TEST(NearMeets, ZeroToleranceJoinsOnlyCornersThatCoincide) {
    const Solid raw = shaken_octahedron(1e-5, 3);
    const ContractedSolid same = contract_near_meets(raw, 0);
    EXPECT_EQ(same.solid.vertices.size(), raw.vertices.size());
    EXPECT_EQ(same.contracted_edges, 0);
}

TEST(NearMeets, LongEdgesStay) {
    const Solid solid = cube();
    const ContractedSolid same = contract_near_meets(solid, 1.9);
    EXPECT_EQ(same.solid.vertices.size(), 8u);
    EXPECT_EQ(same.contracted_edges, 0);
}

// A cube with a corner cut off by a tiny facet: the facet vanishes, the corner returns.
TEST(NearMeets, FacetThatShrinksToAPointVanishes) {
    auto planes = cube_planes();
    planes.push_back({"chip", {glm::normalize(Vec3(1, 1, 1)), std::sqrt(3.0) - 1e-6}});
    const ContractedSolid joined = contract_near_meets(intersect_half_spaces(planes).solid, 1e-4);
    EXPECT_EQ(joined.vanished, std::vector<std::string>{"chip"});
    EXPECT_EQ(joined.solid.vertices.size(), 8u);
    EXPECT_EQ(joined.solid.facets.size(), 6u);
    EXPECT_NEAR(volume(joined.solid), 8, 1e-12);
    EXPECT_TRUE(find_faults(joined.solid).empty());
}

// A bevel of an edge, thinner than the tolerance: it vanishes, and the edge returns.
TEST(NearMeets, ThinBevelVanishes) {
    auto planes = cube_planes();
    planes.push_back({"bevel", {glm::normalize(Vec3(1, 1, 0)), std::sqrt(2.0) - 1e-6}});
    const ContractedSolid joined = contract_near_meets(intersect_half_spaces(planes).solid, 1e-4);
    EXPECT_EQ(joined.vanished, std::vector<std::string>{"bevel"});
    EXPECT_EQ(edge_count(joined.solid), 12);
    EXPECT_NEAR(volume(joined.solid), 8, 1e-12);
}

TEST(NearMeets, AToleranceBeyondTheStoneLeavesNothing) {
    const ContractedSolid joined = contract_near_meets(cube(), 100);
    EXPECT_TRUE(joined.solid.facets.empty() || is_closed(joined.solid));
}

}  // namespace
}  // namespace culet
