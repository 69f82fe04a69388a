#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <set>
#include <tuple>

#include "stone/cuts/cuts.h"
#include "stone/solid/checks.h"
#include "stone/solid/solid.h"
#include "stone/text/errors.h"
#include "tests/stone/synthetic_solids.h"

namespace culet {
namespace {

using namespace culet::test;

TEST(HalfSpaces, CubeHasTheCountsAndVolumeOfACube) {
    const HalfSpaceSolid result = intersect_half_spaces(cube_planes());
    EXPECT_TRUE(result.bounded);
    EXPECT_FALSE(result.empty);
    EXPECT_EQ(result.solid.vertices.size(), 8u);
    EXPECT_EQ(edge_count(result.solid), 12);
    EXPECT_DOUBLE_EQ(volume(result.solid), 8.0);
    EXPECT_EQ(planarity(result.solid), 0.0);
    EXPECT_TRUE(find_faults(result.solid).empty());
}

TEST(HalfSpaces, FacetsFollowTheOrderAndNamesOfThePlanes) {
    const auto planes = random_planes(60, 3);
    const HalfSpaceSolid result = intersect_half_spaces(planes);
    std::size_t next = 0;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        if (next < result.solid.facets.size() && result.solid.facets[next].name == planes[i].name) {
            EXPECT_EQ(result.solid.facets[next].plane.normal, planes[i].plane.normal);
            EXPECT_EQ(result.solid.facets[next].plane.offset, planes[i].plane.offset);
            ++next;
        }
    }
    EXPECT_EQ(next, result.solid.facets.size());
    EXPECT_EQ(result.solid.facets.size() + result.unused_planes.size(), planes.size());
}

// The octahedron with corners at the unit vectors has volume 4/3. Its planes are rounded, so four
// of them slightly miss each other's meet; the exact solid shows that as short edges.
TEST(HalfSpaces, OctahedronVolume) {
    const HalfSpaceSolid result = intersect_half_spaces(octahedron_planes());
    EXPECT_NEAR(volume(result.solid), 4.0 / 3.0, 1e-15);
    const Solid joined = contract_near_meets(result.solid, 1e-9).solid;
    EXPECT_EQ(joined.vertices.size(), 6u);
    EXPECT_EQ(edge_count(joined), 12);
}

// A simple polyhedron of F facets has 2F - 4 vertices and 3F - 6 edges (Euler).
TEST(HalfSpaces, RandomSolidsAreSimpleConvexAndKeepEulersRelation) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        SCOPED_TRACE(seed);
        const Solid solid = random_solid(20 * static_cast<int>(seed), seed);
        const std::size_t facets = solid.facets.size();
        EXPECT_EQ(solid.vertices.size(), 2 * facets - 4);
        EXPECT_EQ(edge_count(solid), static_cast<int>(3 * facets - 6));
        EXPECT_LT(planarity(solid), 1e-14);
        EXPECT_TRUE(is_convex(solid));
        EXPECT_TRUE(find_faults(solid).empty());
    }
}

TEST(HalfSpaces, EveryVertexIsBelowEveryPlane) {
    const auto planes = random_planes(200, 7);
    const Solid solid = intersect_half_spaces(planes).solid;
    for (const NamedPlane& p : planes) {
        for (const Vec3& v : solid.vertices) EXPECT_LE(height_above(p.plane, v), 1e-14);
    }
}

TEST(HalfSpaces, CountsDoNotDependOnScaleOrPlace) {
    const auto planes = random_planes(80, 5);
    const Solid near = intersect_half_spaces(planes).solid;
    for (const double scale : {1e-100, 1e-9, 1e9, 1e100}) {
        auto scaled = planes;
        for (NamedPlane& p : scaled) p.plane.offset *= scale;
        const Solid solid = intersect_half_spaces(scaled).solid;
        EXPECT_EQ(solid.facets.size(), near.facets.size()) << scale;
        EXPECT_EQ(solid.vertices.size(), near.vertices.size()) << scale;
    }
    // A million diameters away the offsets, as doubles, are rounded to 1e-10.
    auto far = planes;
    for (NamedPlane& p : far) p.plane.offset += glm::dot(p.plane.normal, Vec3(1e6, -2e6, 1e6));
    const HalfSpaceSolid result = intersect_half_spaces(far);
    EXPECT_EQ(result.solid.facets.size(), near.facets.size());
    EXPECT_LT(planarity(result.solid), 1e-8);
}

TEST(HalfSpaces, OrderOfThePlanesDoesNotChangeTheSolid) {
    const auto planes = random_planes(60, 11);
    const auto reversed = std::vector<NamedPlane>(planes.rbegin(), planes.rend());
    const Solid a = intersect_half_spaces(planes).solid;
    const Solid b = intersect_half_spaces(reversed).solid;
    EXPECT_EQ(a.facets.size(), b.facets.size());
    EXPECT_EQ(a.vertices.size(), b.vertices.size());
    EXPECT_NEAR(volume(a), volume(b), 1e-13);
    EXPECT_EQ(plane_difference(a, b), 0);
}

/// Planes n . x <= d for all signs and orders of n, in integers: meets of many planes are exact.
void add_family(std::vector<NamedPlane>& planes, int a, int b, int c, double d) {
    std::set<std::array<int, 3>> normals;
    std::array<int, 3> n{a, b, c};
    std::sort(n.begin(), n.end());
    do {
        for (int signs = 0; signs < 8; ++signs) {
            normals.insert(
                {signs & 1 ? -n[0] : n[0], signs & 2 ? -n[1] : n[1], signs & 4 ? -n[2] : n[2]});
        }
    } while (std::next_permutation(n.begin(), n.end()));
    for (const auto& v : normals) {
        planes.push_back(
            {numbered("n", static_cast<int>(planes.size())), {Vec3(v[0], v[1], v[2]), d}});
    }
}

// Counts of the Archimedean and Catalan solids with the cube's symmetry (Coxeter, Regular
// Polytopes).
TEST(HalfSpaces, CubicSolidsWithExactMeetsOfManyPlanes) {
    struct Case {
        const char* name;
        std::vector<std::array<int, 4>> families;  // normal and offset
        std::size_t vertices, facets;
        int edges;
    };
    for (const Case& c : {Case{"cuboctahedron", {{1, 0, 0, 1}, {1, 1, 1, 2}}, 12, 14, 24},
                          Case{"rhombic dodecahedron", {{1, 1, 0, 2}}, 14, 12, 24},
                          Case{"truncated octahedron", {{1, 0, 0, 2}, {1, 1, 1, 3}}, 24, 14, 36},
                          Case{"octahedron", {{1, 1, 1, 1}}, 6, 8, 12}}) {
        SCOPED_TRACE(c.name);
        std::vector<NamedPlane> planes;
        for (const auto& f : c.families) add_family(planes, f[0], f[1], f[2], f[3]);
        const HalfSpaceSolid result = intersect_half_spaces(planes);
        EXPECT_EQ(result.solid.vertices.size(), c.vertices);
        EXPECT_EQ(result.solid.facets.size(), c.facets);
        EXPECT_EQ(edge_count(result.solid), c.edges);
        EXPECT_TRUE(find_faults(result.solid).empty());
        std::reverse(planes.begin(), planes.end());
        EXPECT_EQ(intersect_half_spaces(planes).solid.vertices.size(), c.vertices);
        // Planes that touch only vertices and edges bound no facet.
        const std::size_t before = planes.size();
        add_family(planes, 9, 0, 0, 9 * width_along(result.solid, {1, 0, 0}) / 2);
        const HalfSpaceSolid touched = intersect_half_spaces(planes);
        EXPECT_EQ(touched.solid.vertices.size(), c.vertices);
        EXPECT_EQ(touched.unused_planes.size() + touched.repeated_planes.size(),
                  planes.size() - before);
    }
}

TEST(HalfSpaces, RepeatedPlanesAreToldAndChangeNothing) {
    auto planes = cube_planes();
    planes.push_back({"again", planes[2].plane});
    planes.push_back({"longer", {{2, 0, 0}, 2}});
    const HalfSpaceSolid result = intersect_half_spaces(planes);
    EXPECT_EQ(result.repeated_planes, (std::vector<int>{6, 7}));
    EXPECT_TRUE(result.unused_planes.empty());
    EXPECT_EQ(result.solid.facets.size(), 6u);
}

TEST(HalfSpaces, PlanesThatOnlyTouchAreUnused) {
    auto planes = cube_planes();
    planes.push_back({"edge", {glm::normalize(Vec3(1, 1, 0)), std::sqrt(2.0)}});
    planes.push_back({"away", {{0, 0, 1}, 7}});
    planes.push_back({"corner", {Vec3(3, 4, 12), 19}});
    const HalfSpaceSolid result = intersect_half_spaces(planes);
    EXPECT_EQ(result.solid.vertices.size(), 8u);
    EXPECT_EQ(result.unused_planes, (std::vector<int>{6, 7, 8}));
}

TEST(HalfSpaces, UnnormalisedPlanesComeOutNormalised) {
    auto planes = cube_planes();
    for (NamedPlane& p : planes) {
        p.plane.normal *= 4;
        p.plane.offset *= 4;
    }
    const HalfSpaceSolid result = intersect_half_spaces(planes);
    EXPECT_EQ(result.solid.facets[0].plane.normal, Vec3(1, 0, 0));
    EXPECT_EQ(result.solid.facets[0].plane.offset, 1);
}

TEST(HalfSpaces, OpenAndEmptySolidsAreTold) {
    auto open = cube_planes();
    open.pop_back();
    EXPECT_FALSE(intersect_half_spaces(open).bounded);
    EXPECT_FALSE(intersect_half_spaces({}).bounded);

    auto empty = cube_planes();
    empty.push_back({"beyond", {{0, 0, 1}, -2}});
    EXPECT_TRUE(intersect_half_spaces(empty).empty);
    // Flat: all planes meet at z = 1 only.
    auto flat = cube_planes();
    flat.push_back({"flat", {{0, 0, -1}, -1}});
    EXPECT_TRUE(intersect_half_spaces(flat).empty);
}

// A needle whose tip is 1e8 away: far beyond any guessed bounding box.
TEST(HalfSpaces, NearlyParallelPlanesAreStillBounded) {
    const double tilt = 1e-8;
    std::vector<NamedPlane> planes{{"base", {{0, 0, -1}, 0}}};
    for (int i = 0; i < 4; ++i) {
        const double t = i * std::numbers::pi / 2;
        planes.push_back(
            {numbered("side", i),
             {{std::cos(tilt) * std::cos(t), std::cos(tilt) * std::sin(t), std::sin(tilt)},
              std::cos(tilt)}});
    }
    const HalfSpaceSolid result = intersect_half_spaces(planes);
    ASSERT_TRUE(result.bounded);
    EXPECT_NEAR(width_along(result.solid, {0, 0, 1}), 1 / std::tan(tilt), 1);
}

TEST(HalfSpaces, BadPlanesAreRefused) {
    auto planes = cube_planes();
    planes[3].plane.offset = std::nan("");
    EXPECT_THROW(intersect_half_spaces(planes), InputError);
    planes[3].plane = {{0, 0, 0}, 1};
    EXPECT_THROW(intersect_half_spaces(planes), InputError);
}

// A cut as scanned: every plane is off by microns, so no four meet in one point. Then three edges
// end at each corner (Euler: V = 2F - 4, E = 3F - 6), no plane cuts off a corner, and each corner
// is where its three planes meet by Cramer's rule.
TEST(HalfSpaces, CutsWhoseMeetsMissByMicrons) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> micron(-1e-4, 1e-4);
    for (const char* name : {"round-brilliant", "pear"}) {
        SCOPED_TRACE(name);
        std::vector<NamedPlane> planes;
        for (const Facet& facet : make_cut(name).facets) {
            Plane plane = facet.plane;
            for (int axis = 0; axis < 3; ++axis) plane.normal[axis] += micron(random);
            plane.normal = glm::normalize(plane.normal);
            plane.offset += micron(random);
            planes.push_back({facet.name, plane});
        }
        const HalfSpaceSolid result = intersect_half_spaces(planes);
        const std::size_t facets = planes.size();
        ASSERT_EQ(result.solid.facets.size(), facets);
        EXPECT_EQ(result.solid.vertices.size(), 2 * facets - 4);
        EXPECT_EQ(edge_count(result.solid), static_cast<int>(3 * facets - 6));
        EXPECT_TRUE(is_convex(result.solid));
        std::vector<std::vector<Plane>> of_corner(result.solid.vertices.size());
        for (const Facet& facet : result.solid.facets) {
            for (const int corner : facet.corners)
                of_corner[static_cast<std::size_t>(corner)].push_back(facet.plane);
        }
        for (std::size_t i = 0; i < of_corner.size(); ++i) {
            const Vec3& v = result.solid.vertices[i];
            for (const NamedPlane& p : planes)
                EXPECT_LT(glm::dot(p.plane.normal, v) - p.plane.offset, 1e-9) << p.name;
            ASSERT_EQ(of_corner[i].size(), 3u);
            const auto& [a, b, c] = std::tie(of_corner[i][0], of_corner[i][1], of_corner[i][2]);
            const Vec3 bc = glm::cross(b.normal, c.normal);
            const Vec3 meet = (a.offset * bc + b.offset * glm::cross(c.normal, a.normal) +
                               c.offset * glm::cross(a.normal, b.normal)) /
                              glm::dot(a.normal, bc);
            // Nearly parallel planes amplify the rounding of their coefficients (1e-16).
            EXPECT_LT(glm::length(v - meet), 1e-9);
        }
    }
}

TEST(HalfSpaces, ManyPlanes) {
    const Solid solid = random_solid(1000, 1);
    EXPECT_EQ(solid.vertices.size(), 2 * solid.facets.size() - 4);
}

}  // namespace
}  // namespace culet
