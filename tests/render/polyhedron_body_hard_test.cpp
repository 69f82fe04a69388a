// Hits at edges, corners, notches, holes and slivers. Expectations: small solids by hand; distances
// and solid angles for random starts.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/geometry/polyhedron_body.h"
#include "tests/render/carved_solids.h"

namespace {

using namespace culet;
using namespace culet::carved;

TEST(PolyhedronBodyHard, StartsOnEdgesAndVerticesStayAtTheStone) {
    const unsigned seed = 2206;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform;
    for (const bool turned : {false, true}) {
        for (const auto& [name, upright] : all()) {
            const Solid solid =
                turned ? moved(upright, random_turn(random), 1, {0.1, 0.2, 0.3}) : upright;
            const PolyhedronBody body(solid);
            const double size = diameter(solid), rounding = 1e-13 * size;
            for (std::size_t f = 0; f < solid.facets.size(); ++f) {
                const Facet& facet = solid.facets[f];
                for (std::size_t k = 0; k < 4 * facet.corners.size(); ++k) {
                    const std::size_t count = facet.corners.size(), i = k % count;
                    const Vec3 a = solid.vertices[static_cast<std::size_t>(facet.corners[i])];
                    const Vec3 b =
                        solid.vertices[static_cast<std::size_t>(facet.corners[(i + 1) % count])];
                    const double part = k < count ? 0 : k < 2 * count ? 0.5 : uniform(random);
                    const Vec3 start = a + part * (b - a);
                    Vec3 direction = random_direction(random);
                    if (glm::dot(direction, facet.plane.normal) > 0) direction = -direction;
                    const std::string what = name + " seed " + std::to_string(seed) + " facet " +
                                             facet.name + " corner " + std::to_string(k);

                    const BodyHit out = body.exit(start, direction, static_cast<int>(f));
                    ASSERT_GE(out.facet, 0) << what;
                    ASSERT_GE(out.distance, 0) << what;
                    const Vec3 end = start + out.distance * direction;
                    const double slope = std::abs(glm::dot(direction, body.normal(out.facet)));
                    ASSERT_LT(distance_to_facet(solid, out.facet, end), rounding / slope) << what;
                    if (out.distance > 100 * rounding) {
                        ASSERT_GT(winding_of(solid, 0.5 * (start + end)), 0.5) << what;
                    }

                    const auto in = body.reentry(start, -direction, static_cast<int>(f));
                    if (!in) continue;
                    ASSERT_GE(in->distance, 0) << what;
                    const Vec3 there = start - in->distance * direction;
                    const double steep = std::abs(glm::dot(direction, body.normal(in->facet)));
                    ASSERT_LT(distance_to_facet(solid, in->facet, there), rounding / steep) << what;
                    if (in->distance > 100 * rounding) {
                        ASSERT_LT(winding_of(solid, 0.5 * (start + there)), 0.5) << what;
                    }
                }
            }
        }
    }
}

TEST(PolyhedronBodyHard, StartBeyondAConvexEdgeLeavesAtOnceAndLeapsOverNoGap) {
    // The inner wall of the left arm is facet 7 (x = 1), its top end facet 8 (y = 3).
    const Solid solid = u_prism();
    const PolyhedronBody body(solid);
    ASSERT_EQ(body.normal(7), (Vec3{1, 0, 0}));
    ASSERT_EQ(body.normal(8), (Vec3{0, 1, 0}));
    for (const double beyond : {0.0, 1e-16, 4e-16, 1e-15}) {
        // Starts on the end of the left arm, beyond its edge, and runs down into the gap.
        const Vec3 down = glm::normalize(Vec3{2, -1, 0});
        const BodyHit corner = body.exit({1 + beyond, 3, 0.5}, down, 8);
        EXPECT_EQ(corner.facet, 7) << beyond;
        EXPECT_LT(corner.distance, 1e-15);
        // From there across the gap into the right arm's wall x = 2, 1/2 further down.
        const auto across = body.reentry(body.on_facet(7, {1 + beyond, 3, 0.5}), down, 7);
        ASSERT_TRUE(across.has_value());
        EXPECT_EQ(body.normal(across->facet), (Vec3{-1, 0, 0}));
        EXPECT_NEAR(across->distance, std::sqrt(1.25), 1e-14);
    }
}

TEST(PolyhedronBodyHard, StartBeyondAConcaveEdgeGoesOnInside) {
    // The L's concave edge x = 1, y = 1: facet 4 above y = 1, facet 5 beside x = 1.
    const PolyhedronBody body(l_prism());
    ASSERT_EQ(body.normal(4), (Vec3{0, 1, 0}));
    ASSERT_EQ(body.normal(5), (Vec3{1, 0, 0}));
    for (const double beyond : {-1e-15, -1e-16, 0.0, 1e-16, 1e-15}) {
        // Down from y = 1 past the edge into the foot and out at y = 0.
        const BodyHit down = body.exit({1 + beyond, 1, 0.5}, {-0.6, -0.8, 0}, 4);
        EXPECT_EQ(body.normal(down.facet), (Vec3{0, -1, 0})) << beyond;
        EXPECT_NEAR(down.distance, 1.25, 1e-14);
        // From y = 1 to the left, hardly downwards, through the upright and out at x = 0.
        const Vec3 grazing = glm::normalize(Vec3{-1, -1e-9, 0});
        const BodyHit left = body.exit({1 + beyond, 1, 0.5}, grazing, 4);
        EXPECT_EQ(body.normal(left.facet), (Vec3{-1, 0, 0})) << beyond;
        EXPECT_NEAR(left.distance, 1, 1e-14);
        // Out into the corner, beside the edge: it may leave or enter again at once.
        const auto out = body.reentry({1 + beyond, 1, 0.5}, {-0.6, 0.8, 0}, 4);
        ASSERT_TRUE(out.has_value()) << beyond;
        EXPECT_EQ(out->facet, 5);
        EXPECT_LT(out->distance, 1e-14);
        EXPECT_FALSE(body.reentry({1 + beyond, 1, 0.5}, {0.6, 0.8, 0}, 4).has_value());
    }
}

TEST(PolyhedronBodyHard, RayGrazingAlongAConcaveEdge) {
    const unsigned seed = 2207;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const PolyhedronBody body(l_prism());
    for (const double tilt : {0.0, 1e-300, 1e-20, 1e-17, 1e-16, 1e-15, 1e-12, 1e-8, 1e-4}) {
        for (int i = 0; i < 200; ++i) {
            const Vec3 direction =
                glm::normalize(Vec3{tilt * uniform(random), tilt * uniform(random), 1});
            const Vec3 below{1 + tilt * uniform(random), 1 + tilt * uniform(random), -1};
            const auto in = body.entry(below, direction);
            // Beside the edge three quarters of the directions are inside.
            for (const int from : {-1, 4, 5}) {
                const BodyHit out = body.exit({1, 1, 0.25}, direction, from);
                ASSERT_TRUE(out.facet == 0 || out.facet == 4 || out.facet == 5) << tilt;
                ASSERT_GE(out.distance, 0);
                ASSERT_LE(out.distance, 0.75 + 1e-7);
            }
            if (!in) continue;
            ASSERT_TRUE(in->facet == 1 || in->facet == 4 || in->facet == 5) << tilt;
            ASSERT_GE(in->distance, 1 - 1e-7);
            ASSERT_LE(in->distance, 2 + 1e-7);
        }
    }
}

TEST(PolyhedronBodyHard, StartInAFacetSeenEdgeOnRunsAlongIt) {
    // Inside by less than rounding error along the side x = 3 of the L: out through the top.
    const PolyhedronBody body(l_prism());
    for (const double inwards : {1e-300, 1e-20, 1e-17, 1e-16}) {
        const BodyHit out = body.exit({3, 0.5, 0.25}, {-inwards, 0, 1}, 3);
        EXPECT_EQ(out.facet, 0) << inwards;
        EXPECT_EQ(out.distance, 0.75);
    }
}

TEST(PolyhedronBodyHard, ValleyOfANotchIsEnteredAgainAtOnce) {
    const PolyhedronBody body(notched_box());
    // Down through the hole of the top facet onto the apex; the line passes exactly through the
    // apex.
    const auto apex = body.entry({0, 0, 5}, {0, 0, -1});
    ASSERT_TRUE(apex.has_value());
    EXPECT_GE(apex->facet, 6);
    EXPECT_EQ(apex->distance, 6);
    EXPECT_EQ(body.exit({0, 0, -1}, {0, 0, -1}, apex->facet).facet, 1);
    // Across the notch close above the apex, where it is 2 h / 3 wide.
    for (const double h : {1.0, 1e-3, 1e-9, 1e-15}) {
        const BodyHit out = body.exit({-2, 0.1 * h, -1 + h}, {1, 0, 0}, 5);
        EXPECT_EQ(out.facet, 9);
        const Vec3 wall = body.on_facet(9, {-2 + out.distance, 0.1 * h, -1 + h});
        const auto in = body.reentry(wall, {1, 0, 0}, 9);
        ASSERT_TRUE(in.has_value());
        EXPECT_EQ(in->facet, 7);
        EXPECT_NEAR(in->distance, 2 * h / 3, 1e-15);
    }
    EXPECT_FALSE(body.contains({0, 0, -0.9}));
    EXPECT_FALSE(body.contains({0, 0, -1}));
    EXPECT_TRUE(body.contains({0, 0, -1.1}));
}

TEST(PolyhedronBodyHard, FacetWithAHoleLetsTheRayThrough) {
    const PolyhedronBody body(ring());
    EXPECT_FALSE(body.entry({0, 0, 5}, {0, 0, -1}).has_value());
    EXPECT_FALSE(body.entry({0.9, 0.9, 5}, {0, 0, -1}).has_value());
    for (const double shift : {-1e-17, 0.0, 1e-17}) {
        const auto hit = body.entry({-2 + shift, -2, 5}, {0, 0, -1});
        ASSERT_TRUE(hit.has_value());
        EXPECT_EQ(hit->facet, 0);
        EXPECT_EQ(hit->distance, 4);
    }
    const BodyHit wall = body.exit({-3, 0, 0.5}, {1, 0, 0}, 5);
    EXPECT_EQ(wall.facet, 9);
    EXPECT_EQ(wall.distance, 2);
    const auto again = body.reentry({-1, 0, 0.5}, {1, 0, 0}, 9);
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(again->facet, 7);
    EXPECT_EQ(again->distance, 2);
    EXPECT_FALSE(body.reentry({3, 0, 0.5}, {1, 0, 0}, 3).has_value());
}

TEST(PolyhedronBodyHard, EdgeThatFourFacetsShare) {
    const PolyhedronBody body(cubes_on_one_edge());
    // Through the edge: from one cube straight into the other, or out and in again at once.
    const BodyHit hit = body.exit({-1, -1, 0.5}, glm::normalize(Vec3{1, 1, 0}), 9);
    EXPECT_NEAR(hit.distance, hit.distance > 2 ? 2 * std::sqrt(2.0) : std::sqrt(2.0), 1e-15);
    // Across it, through the two free quadrants.
    const auto miss = body.entry({-1, 1, 0.5}, glm::normalize(Vec3{1, -1, 0}));
    if (miss) {
        EXPECT_NEAR(miss->distance, std::sqrt(2.0), 1e-15);
    }
}

TEST(PolyhedronBodyHard, ThinWedgeIsLeftWhereItIsEntered) {
    // A wedge of 1e-9 radians: near its edge, crossings are closer together than their rounding
    // error.
    const double thin = 1e-9;
    const PolyhedronBody body(prism({{0, 0}, {1, 0}, {1, thin}}, 0, 1));
    const unsigned seed = 2208;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < 2000; ++i) {
        const double x = std::pow(10, -16 * uniform(random));
        Vec3 direction = random_direction(random);
        direction.y = std::abs(direction.y);
        const BodyHit out = body.exit({x, 0, uniform(random)}, direction, 2);
        ASSERT_GE(out.distance, 0);
        ASSERT_LE(out.distance, std::sqrt(2.0) + 1e-7);
        ASSERT_NE(out.facet, 2) << "seed " << seed << " ray " << i;
    }
}

TEST(PolyhedronBodyHard, StartOutsideByRoundingInTheMiddleOfAFacet) {
    // Above the top by one rounding unit: upwards it leaves at once, downwards it enters and passes
    // through.
    const PolyhedronBody body(l_prism());
    const Vec3 above{0.5, 0.75, std::nextafter(1.0, 2.0)};
    for (const int from : {-1, 3}) {
        const BodyHit up = body.exit(above, {0.6, 0, 0.8}, from);
        EXPECT_EQ(up.facet, 0) << from;
        EXPECT_EQ(up.distance, 0);
        const BodyHit down = body.exit(above, {0, 0, -1}, from);
        EXPECT_EQ(down.facet, 1) << from;
        EXPECT_NEAR(down.distance, 1, 1e-15);
    }
}

TEST(PolyhedronBodyHard, StartOffItsPlaneByRoundingAndGrazingKeepsItsDistance) {
    // 1e-16 below y = 0 (facet 2) the ray rises by 1e-9 of its length: by the planes alone it would
    // meet its own facet after 1e-7, twice as far as the end at x = 1.
    const PolyhedronBody body(prism({{0, 0}, {1, 0}, {1, 1}}, 0, 1));
    const BodyHit hit = body.exit({1 - 5e-8, -1e-16, 0.5}, {1, 1e-9, 1}, 2);
    EXPECT_EQ(body.normal(hit.facet), (Vec3{1, 0, 0}));
    EXPECT_NEAR(hit.distance, 5e-8, 1e-15);
}

TEST(PolyhedronBodyHard, RayThatOnlyTouchesAnEdgeOrCornerDoesNotEnter) {
    const Solid cube = prism({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, -1, 1);
    const PolyhedronBody body(cube);
    for (int axis = 0; axis < 3; ++axis) {
        for (const int first : {-1, 1}) {
            for (const int second : {-1, 1}) {
                for (const double along : {-1.0, 0.25, 1.0}) {
                    Vec3 touch{0, 0, 0}, direction{0, 0, 0};
                    touch[axis] = along;
                    touch[(axis + 1) % 3] = first;
                    touch[(axis + 2) % 3] = second;
                    direction[(axis + 1) % 3] = first;
                    direction[(axis + 2) % 3] = -second;
                    EXPECT_FALSE(body.entry(touch - 2.0 * direction, direction).has_value());
                    EXPECT_FALSE(body.entry(touch + 2.0 * direction, -direction).has_value());
                }
            }
        }
    }
}

TEST(PolyhedronBodyHard, SideOfAnEdgeIsDecidedExactly) {
    // With e = 2^-52, the edge from a to b passes the axis at e^2 / 2 on its right or, mirrored, on
    // its left; after rounding the two products of the side test are equal.
    const double e = std::numeric_limits<double>::epsilon();
    for (const double mirror : {1.0, -1.0}) {
        // An inverted pyramid, its top split along a b.
        std::vector<Vec3> vertices{
            {-(1 + e), -1, 1}, {1, -1, 1}, {1 + 2 * e, 1 + e, 1}, {-1, 1, 1}, {0.125, 0.25, -1}};
        Loops loops{{0, 1, 2}, {0, 2, 3}, {1, 0, 4}, {2, 1, 4}, {3, 2, 4}, {0, 3, 4}};
        for (Vec3& vertex : vertices) vertex.x *= mirror;
        if (mirror < 0) {
            for (std::vector<int>& loop : loops) std::reverse(loop.begin(), loop.end());
        }
        // a.x b.y - a.y b.x = -mirror e^2: always on the side of vertex 1, in facet 0.
        const auto hit = PolyhedronBody(solid_of(vertices, loops)).entry({0, 0, 2}, {0, 0, -1});
        ASSERT_TRUE(hit.has_value());
        EXPECT_EQ(hit->facet, 0) << mirror;
    }
}

}  // namespace
