#include "stone/solid/checks.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "tests/says.h"
#include "tests/stone/synthetic_solids.h"

namespace culet {
namespace {

using namespace culet::test;

bool has(const std::vector<Fault>& faults, FaultKind kind) {
    return std::any_of(faults.begin(), faults.end(),
                       [&](const Fault& fault) { return fault.kind == kind; });
}

void set_planes(Solid& solid) {
    for (Facet& facet : solid.facets) {
        std::vector<Vec3> loop;
        for (const int corner : facet.corners) loop.push_back(solid.vertices[corner]);
        facet.plane = plane_through(loop);
    }
}

TEST(Checks, SoundSolidsHaveNoFaults) {
    EXPECT_TRUE(find_faults(cube()).empty());
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        EXPECT_TRUE(find_faults(random_solid(100, seed)).empty()) << seed;
    }
}

TEST(Checks, VerdictsDoNotDependOnScalePlaceOrTurn) {
    const Solid solid = random_solid(60, 9);
    for (const double scale : {1e-12, 1e-3, 1e3, 1e12}) {
        for (const double shift : {0.0, 1e3}) {
            const Solid other = moved(solid, scale, scale * Vec3(shift, -shift, shift));
            EXPECT_TRUE(is_convex(other)) << scale << " " << shift;
            EXPECT_TRUE(find_faults(other).empty()) << scale << " " << shift;
        }
    }
}

TEST(Checks, EmptySolid) {
    EXPECT_TRUE(has(find_faults(Solid{}), FaultKind::empty));
    EXPECT_FALSE(is_closed(Solid{}));
    EXPECT_FALSE(is_convex(Solid{}));
}

TEST(Checks, MissingFacetIsAnOpenSurface) {
    Solid solid = cube();
    solid.facets.pop_back();
    const auto faults = find_faults(solid);
    EXPECT_EQ(faults.size(), 4u);  // one per edge
    EXPECT_EQ(edge_count(solid), 12);
    EXPECT_TRUE(has(faults, FaultKind::open));
    EXPECT_FALSE(is_closed(solid));
    EXPECT_FALSE(is_convex(solid));
}

TEST(Checks, NotFinite) {
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        Solid solid = cube();
        solid.vertices[3].y = bad;
        EXPECT_TRUE(has(find_faults(solid), FaultKind::not_finite));
        EXPECT_FALSE(is_convex(solid));
        solid = cube();
        solid.facets[2].plane.offset = bad;
        EXPECT_TRUE(has(find_faults(solid), FaultKind::not_finite));
    }
}

TEST(Checks, CornersThatDoNotExist) {
    for (const int bad : {-1, 8, 1 << 30}) {
        Solid solid = cube();
        solid.facets[1].corners[2] = bad;
        EXPECT_TRUE(has(find_faults(solid), FaultKind::degenerate_facet));
        EXPECT_FALSE(is_closed(solid));
        EXPECT_FALSE(is_convex(solid));
    }
}

TEST(Checks, FacetWithTwoCornersOrARepeatedOne) {
    Solid solid = cube();
    solid.facets.push_back({"two", {}, {0, 1}});
    EXPECT_TRUE(has(find_faults(solid), FaultKind::degenerate_facet));
    solid = cube();
    solid.facets[0].corners.push_back(solid.facets[0].corners[0]);
    EXPECT_TRUE(has(find_faults(solid), FaultKind::degenerate_facet));
    EXPECT_FALSE(is_closed(solid));
    solid = cube();
    solid.facets.push_back({"none", {}, {}});
    EXPECT_TRUE(has(find_faults(solid), FaultKind::degenerate_facet));
}

TEST(Checks, FacetWithoutArea) {
    Solid solid = cube();
    for (Vec3& v : solid.vertices) v = Vec3(v.x, 0, 0);
    EXPECT_TRUE(has(find_faults(solid), FaultKind::degenerate_facet));
    EXPECT_FALSE(is_convex(solid));
    for (Vec3& v : solid.vertices) v = Vec3(3, 3, 3);
    EXPECT_FALSE(find_faults(solid).empty());
    EXPECT_FALSE(is_convex(solid));
}

TEST(Checks, EdgeWithThreeFacets) {
    Solid solid = cube();
    solid.facets.push_back(solid.facets[0]);
    solid.facets.back().name = "fin";
    EXPECT_TRUE(has(find_faults(solid), FaultKind::not_manifold));
    EXPECT_FALSE(is_closed(solid));
}

TEST(Checks, TwoConesThatShareATip) {
    Solid solid;
    solid.vertices = {{0, 0, 0},  {1, 0, 1},   {-1, 1, 1},  {-1, -1, 1},
                      {1, 0, -1}, {-1, 1, -1}, {-1, -1, -1}};
    int next = 0;
    const auto add = [&](std::vector<int> corners) {
        solid.facets.push_back({std::to_string(next++), {}, std::move(corners)});
    };
    add({0, 1, 2}), add({0, 2, 3}), add({0, 3, 1}), add({1, 3, 2});
    add({0, 5, 4}), add({0, 6, 5}), add({0, 4, 6}), add({4, 5, 6});
    set_planes(solid);
    const auto faults = find_faults(solid);
    EXPECT_TRUE(has(faults, FaultKind::not_manifold));
    EXPECT_TRUE(has(faults, FaultKind::several_pieces));
    EXPECT_FALSE(is_closed(solid));
}

TEST(Checks, OneFacetTurnedOver) {
    Solid solid = cube();
    std::reverse(solid.facets[0].corners.begin(), solid.facets[0].corners.end());
    EXPECT_TRUE(has(find_faults(solid), FaultKind::misoriented));
    EXPECT_FALSE(is_closed(solid));
}

TEST(Checks, AllFacetsTurnedOver) {
    const Solid solid = turned_inside_out(cube());
    const auto faults = find_faults(solid);
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0].kind, FaultKind::inside_out);
    EXPECT_TRUE(is_closed(solid));
    EXPECT_FALSE(is_convex(solid));
}

TEST(Checks, TwoCubes) {
    Solid solid = cube();
    const Solid other = moved(cube(), 1, {5, 0, 0}, false);
    for (Facet facet : other.facets) {
        facet.name += "b";
        for (int& corner : facet.corners) corner += 8;
        solid.facets.push_back(facet);
    }
    solid.vertices.insert(solid.vertices.end(), other.vertices.begin(), other.vertices.end());
    const auto faults = find_faults(solid);
    // Each part is convex; the only fault is that there are two.
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0].kind, FaultKind::several_pieces);
    EXPECT_THAT(faults[0].what, says("one of 6", "one of 6", "keep"));
}

TEST(Checks, RaisedCornerIsNotPlanar) {
    Solid solid = cube();
    solid.vertices[0] *= 1.001;
    EXPECT_TRUE(has(find_faults(solid), FaultKind::not_planar));
    CheckLimits loose;
    loose.planarity = 0.01;
    EXPECT_FALSE(has(find_faults(solid, loose), FaultKind::not_planar));
}

TEST(Checks, CrossedOutline) {
    Solid solid = cube();
    std::swap(solid.facets[0].corners[0], solid.facets[0].corners[1]);
    EXPECT_TRUE(has(find_faults(solid), FaultKind::self_crossing));
    EXPECT_FALSE(is_convex(solid));
}

TEST(Checks, UnusedVertexAndRepeatedName) {
    Solid solid = cube();
    solid.vertices.push_back({0, 0, 0});
    solid.facets[0].name = solid.facets[1].name;
    const auto faults = find_faults(solid);
    ASSERT_EQ(faults.size(), 2u);
    EXPECT_EQ(faults[0].kind, FaultKind::unused_vertex);
    EXPECT_EQ(faults[1].kind, FaultKind::repeated_name);
}

TEST(Checks, FacetSplitInTwoIsARepeatedPlane) {
    Solid solid = triangulated(cube());
    const auto faults = find_faults(solid);
    EXPECT_TRUE(has(faults, FaultKind::repeated_plane));
    EXPECT_TRUE(is_convex(solid));
}

TEST(Checks, WorstKindFirstAndLongListsCut) {
    Solid solid = cube();
    solid.facets.pop_back();
    for (int i = 0; i < 50; ++i) solid.vertices.push_back({0, 0, 0});
    const auto faults = find_faults(solid);
    EXPECT_EQ(faults.front().kind, FaultKind::open);
    EXPECT_EQ(faults.size(), 4u + 21u);
    EXPECT_EQ(faults.back().what, "and 30 more");
    EXPECT_TRUE(std::is_sorted(faults.begin(), faults.end(),
                               [](const Fault& a, const Fault& b) { return a.kind < b.kind; }));
}

// A block whose top is split along a diagonal: raising the diagonal's ends makes a ridge, lowering
// them a valley, however shallow.
TEST(Convexity, ShallowValleyIsSeen) {
    Solid solid;
    solid.vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0},
                      {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
    int next = 0;
    const auto add = [&](std::vector<int> corners) {
        solid.facets.push_back({std::to_string(next++), {}, std::move(corners)});
    };
    add({0, 3, 2, 1});
    for (int i = 0; i < 4; ++i) {
        const int j = (i + 1) % 4;
        add({i, j, 4 + j}), add({i, 4 + j, 4 + i});
    }
    add({4, 5, 6}), add({4, 6, 7});
    for (const double lift : {0.0, 1e-15, 1e-12, 1e-3}) {
        solid.vertices[4].z = solid.vertices[6].z = 1 + lift;
        set_planes(solid);
        EXPECT_TRUE(is_convex(solid)) << lift;
    }
    for (const double dent : {1e-14, 1e-12, 1e-6, 1e-3}) {
        solid.vertices[4].z = solid.vertices[6].z = 1 - dent;
        set_planes(solid);
        EXPECT_FALSE(is_convex(solid)) << dent;
    }
}

// A roof whose four planes nearly meet: x + z = 1, -x + z = 1, +-y + z = 1 + m. The true ridge is
// that of the lower pair, z = 1, |y| <= m. Here the edge is flipped to the other pair: all corners
// are still exact meets of planes, but two outlines run back on themselves by 2 m.
TEST(Convexity, FlippedShortEdgeIsNeverConvex) {
    for (const double m : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
        SCOPED_TRACE(m);
        Solid solid;
        solid.vertices = {{-1, -1 - m, 0}, {1, -1 - m, 0}, {1, 1 + m, 0},
                          {-1, 1 + m, 0},  {-m, 0, 1 + m}, {m, 0, 1 + m}};
        const double c = std::sqrt(0.5);
        solid.facets = {{"base", {{0, 0, -1}, 0}, {0, 3, 2, 1}},
                        {"px", {{c, 0, c}, c}, {1, 2, 4}},
                        {"mx", {{-c, 0, c}, c}, {3, 0, 5}},
                        {"py", {{0, c, c}, c * (1 + m)}, {2, 3, 5, 4}},
                        {"my", {{0, -c, c}, c * (1 + m)}, {0, 1, 4, 5}}};
        ASSERT_TRUE(is_closed(solid));
        ASSERT_LT(planarity(solid), 1e-15);
        EXPECT_FALSE(is_convex(solid));
        const auto faults = find_faults(solid);
        EXPECT_TRUE(has(faults, FaultKind::not_convex));
        EXPECT_TRUE(has(faults, FaultKind::self_crossing));

        // With the right ridge the same planes make a convex solid.
        solid.vertices[4] = {0, -m, 1};
        solid.vertices[5] = {0, m, 1};
        solid.facets[1].corners = {1, 2, 5, 4};
        solid.facets[2].corners = {3, 0, 4, 5};
        solid.facets[3].corners = {2, 3, 5};
        solid.facets[4].corners = {0, 1, 4};
        EXPECT_TRUE(is_convex(solid));
        EXPECT_TRUE(find_faults(solid).empty());
    }
}

TEST(Convexity, DentedCubeIsNotConvex) {
    Solid solid = cube();
    const int top = find_facet(solid, "pz");
    const std::vector<int> corners = solid.facets[top].corners;
    solid.facets.erase(solid.facets.begin() + top);
    solid.vertices.push_back({0, 0, 0.5});
    for (int i = 0; i < 4; ++i) {
        solid.facets.push_back({numbered("d", i), {}, {corners[i], corners[(i + 1) % 4], 8}});
    }
    set_planes(solid);
    EXPECT_TRUE(is_closed(solid));
    EXPECT_FALSE(is_convex(solid));
    const auto faults = find_faults(solid);
    EXPECT_EQ(faults.size(), 4u);  // one per valley
    CheckLimits limits;
    limits.must_be_convex = false;
    EXPECT_TRUE(find_faults(solid, limits).empty());
}

// A surface that covers the same tetrahedron twice is closed and locally convex almost everywhere.
TEST(Convexity, NoSurfaceThatWindsTwice) {
    Solid solid;
    solid.vertices = {{0, 0, 1}, {0, 0, -1}};
    // A double pyramid whose belt goes round twice: 5 corners, each a step of two fifths.
    for (int i = 0; i < 5; ++i) {
        const double t = 2 * std::acos(-1.0) * (2 * i) / 5.0;
        solid.vertices.push_back({std::cos(t), std::sin(t), 0});
    }
    for (int i = 0; i < 5; ++i) {
        const int a = 2 + i, b = 2 + (i + 1) % 5;
        solid.facets.push_back({numbered("u", i), {}, {0, a, b}});
        solid.facets.push_back({numbered("l", i), {}, {1, b, a}});
    }
    set_planes(solid);
    EXPECT_TRUE(is_closed(solid));
    EXPECT_FALSE(is_convex(solid));
}

TEST(Checks, EveryKindHasAName) {
    for (int kind = 0; kind <= static_cast<int>(FaultKind::repeated_plane); ++kind) {
        EXPECT_STRNE(name_of(static_cast<FaultKind>(kind)), "unknown");
    }
}

}  // namespace
}  // namespace culet
