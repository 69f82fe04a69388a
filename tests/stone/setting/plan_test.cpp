// Outlines, places on them, wires and gaps from which a setting is made. Expectations: closed
// forms, stated with each test.

#include "stone/solid/plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "stone/cuts/cuts.h"
#include "stone/setting/gap.h"
#include "stone/setting/places.h"
#include "stone/setting/section_path.h"
#include "stone/text/errors.h"
#include "tests/stone/synthetic_solids.h"

namespace culet {
namespace {

constexpr double k_pi = std::numbers::pi;

PlanOutline polygon(int sides, double radius) {
    PlanOutline points;
    for (int i = 0; i < sides; ++i)
        points.emplace_back(radius * std::cos(2 * k_pi * i / sides),
                            radius * std::sin(2 * k_pi * i / sides));
    return points;
}

double area_of(const PlanOutline& outline) {
    double area = 0;
    for (std::size_t i = 0; i < outline.size(); ++i)
        area += 0.5 * cross(outline[i], outline[(i + 1) % outline.size()]);
    return area;
}

double volume_of(const Shell& shell) {
    double volume = 0;
    for (const auto& t : shell.triangles)
        volume +=
            glm::dot(shell.vertices[t[0]], glm::cross(shell.vertices[t[1]], shell.vertices[t[2]])) /
            6;
    return volume;
}

TEST(Girdle, OfACubeIsItsMiddleAndOfAnOctahedronItsEquator) {
    // A section of a cube of edge 2 along its edges is a square of area 4 at all heights.
    const GirdleOutline square = girdle_outline(test::cube());
    EXPECT_NEAR(square.height, 0, 1e-12);
    EXPECT_EQ(square.points.size(), 4u);
    EXPECT_NEAR(area_of(square.points), 4, 1e-12);
    // |x| + |y| + |z| = 1 is widest at z = 0, with area 2; the girdle is the middle of the band
    // where the area 2 (1 - |z|)^2 is at least 0.998 of that.
    const Solid octahedron = intersect_half_spaces(test::octahedron_planes()).solid;
    const GirdleOutline equator = girdle_outline(octahedron);
    EXPECT_NEAR(equator.height, 0, 1e-12);
    EXPECT_NEAR(area_of(equator.points), 2, 1e-9);
}

TEST(Girdle, OfEveryCutIsAtZero) {
    // cuts.h: the middle of the girdle is at z = 0.
    for (const CutKind& kind : cut_kinds())
        EXPECT_NEAR(girdle_outline(make_cut(kind.name)).height, 0, 1e-9) << kind.name;
}

TEST(MovedOutline, KeepsEdgesParallelAndCornersInTheirOrder) {
    // A regular polygon of inner radius r moved by d is one of inner radius r + d.
    for (const double by : {-0.5, 0.25, 3.0}) {
        const PlanOutline start = polygon(12, 2), moved = moved_outline(start, by);
        const double inner = 2 * std::cos(k_pi / 12);
        for (std::size_t i = 0; i < start.size(); ++i)
            EXPECT_LT(glm::length(moved[i] - start[i] * ((inner + by) / inner)), 1e-12);
    }
}

TEST(MovedOutline, LetsEdgesVanish) {
    // A square of side 4 with corners cut off by 0.1: at 0.5 inward the cut corners, which shrink
    // by 2 (sqrt(2) - 1) per unit, are gone, and a square of side 3 is left. The corners of a
    // vanished edge go to one point.
    const PlanOutline square{{-2, -1.9}, {-1.9, -2}, {1.9, -2}, {2, -1.9},
                             {2, 1.9},   {1.9, 2},   {-1.9, 2}, {-2, 1.9}};
    const PlanOutline moved = moved_outline(square, -0.5);
    ASSERT_EQ(moved.size(), 8u);
    EXPECT_EQ(moved[0], moved[1]);
    EXPECT_LT(glm::length(moved[0] - PlanPoint(-1.5, -1.5)), 1e-12);
    EXPECT_NEAR(area_of(moved), 9, 1e-12);
    EXPECT_THROW(moved_outline(square, -2.5), InputError);
    // Outward, the edges of a notch vanish: a dent of depth 0.2 and half width 0.2 in a side.
    const PlanOutline notched{{0, 0}, {4, 0}, {4, 4}, {2.2, 4}, {2, 3.8}, {1.8, 4}, {0, 4}};
    const PlanOutline grown = moved_outline(notched, 1);
    EXPECT_NEAR(area_of(grown), 36, 1e-12);
}

TEST(Places, CornersComeFirst) {
    const PlanOutline square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    const GripOutline grip(square);
    EXPECT_EQ(grip.corners(), 4);
    EXPECT_EQ(grip.usual_prongs(), 4);
    for (const GirdlePlace& place : grip.places(4, 0.2)) {
        // At the corner the normal is the bisector.
        EXPECT_NEAR(std::abs(place.at.x), 1, 1e-12);
        EXPECT_NEAR(std::abs(place.at.y), 1, 1e-12);
        EXPECT_NEAR(glm::dot(place.outward, glm::normalize(place.at)), 1, 1e-12);
    }
    // Eight includes the middles of the sides.
    int middles = 0;
    for (const GirdlePlace& place : grip.places(8, 0.2))
        if (std::min(std::abs(place.at.x), std::abs(place.at.y)) < 1e-12) ++middles;
    EXPECT_EQ(middles, 4);
}

TEST(Places, ARoundOutlineHasThemAtEvenDistances) {
    const GripOutline grip(polygon(96, 3));
    EXPECT_EQ(grip.corners(), 0);
    const auto places = grip.places(6, 0.5);
    for (int i = 0; i < 6; ++i) {
        // On both sides of the x axis: at 30, 90, ... degrees, within the polygon's sagitta.
        const double angle = k_pi / 6 + i * k_pi / 3;
        const PlanPoint at{3 * std::cos(angle), 3 * std::sin(angle)};
        EXPECT_LT(glm::length(places[i].at - at), 3 * (1 - std::cos(k_pi / 96)) + 1e-12);
        EXPECT_GT(glm::dot(places[i].outward, glm::normalize(at)), std::cos(k_pi / 96));
    }
}

TEST(Places, OfEveryCutAreAsTheTradeHasThem) {
    // Prongs of usual solitaires: trillion, princess and step cuts at their corners, marquise and
    // pear at their points.
    const std::map<std::string, int> usual{
        {"round-brilliant", 6}, {"step", 4}, {"asscher", 4},  {"princess", 4}, {"oval", 6},
        {"marquise", 6},        {"pear", 5}, {"trillion", 3}, {"cushion", 4},  {"heart", 5}};
    for (const CutKind& kind : cut_kinds()) {
        const GripOutline grip(girdle_outline(make_cut(kind.name)).points);
        ASSERT_TRUE(usual.contains(kind.name)) << kind.name;
        EXPECT_EQ(grip.usual_prongs(), usual.at(kind.name)) << kind.name;
    }
    // No prong is in the notch of a heart, at -x.
    const GripOutline heart(girdle_outline(make_cut("heart")).points);
    for (int count = 2; count < 12; ++count) {
        for (const GirdlePlace& place : heart.places(count, 0.5))
            EXPECT_LT(
                std::abs(distance_outside(girdle_outline(make_cut("heart")).points, place.at)),
                1e-9);
    }
}

TEST(Wire, HasTheVolumeOfItsPrisms) {
    // A mitred wire whose cross-section is symmetric about its middle line has the volume (area of
    // the cross-section) x (length of the middle line).
    constexpr int k_sides = 24, k_steps = 40;
    constexpr double k_radius = 0.5, k_ring = 4;
    std::vector<Vec3> path;
    for (const PlanPoint& point : polygon(k_steps, k_ring)) path.emplace_back(point.x, point.y, 1);
    const Shell ring = closed_wire(path, k_radius, {0, 0, 1}, k_sides);
    EXPECT_TRUE(is_closed(ring));
    const double section = 0.5 * k_sides * k_radius * k_radius * std::sin(2 * k_pi / k_sides);
    const double length = k_steps * 2 * k_ring * std::sin(k_pi / k_steps);
    EXPECT_NEAR(volume_of(ring), section * length, 1e-12 * section * length);
    // Straight, with half balls: vertices are on the ball and the cylinder, so the volume is
    // smaller, by about 2 (pi / sides)^2 of it to second order; 4 (pi / sides)^2 is allowed.
    const Shell rod = round_wire({{0, 0, 0}, {0, 0, 5}}, k_radius, {1, 0, 0}, k_sides);
    EXPECT_TRUE(is_closed(rod));
    const double solid = k_pi * k_radius * k_radius * 5 + 4 * k_pi / 3 * std::pow(k_radius, 3);
    EXPECT_LT(volume_of(rod), solid);
    EXPECT_GT(volume_of(rod), solid * (1 - 4 * std::pow(k_pi / k_sides, 2)));
}

TEST(Collar, OfASquareHasTheVolumeOfItsWalls) {
    const PlanOutline square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    // From 0.5 inside to 0.25 outside and 2 high: (2.5^2 - 1^2) 2.
    const Shell collar = swept_collar(square, {{-0.5, 0}, {0.25, 0}, {0.25, 2}, {-0.5, 2}});
    EXPECT_TRUE(is_closed(collar));
    EXPECT_NEAR(volume_of(collar), (2.5 * 2.5 - 1) * 2, 1e-12);
}

TEST(Gap, OfTriangles) {
    const Triangle flat{Vec3{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    const auto moved = [&](const Vec3& by) {
        return Triangle{flat[0] + by, flat[1] + by, flat[2] + by};
    };
    EXPECT_DOUBLE_EQ(distance_between(flat, moved({0, 0, 1.5})), 1.5);
    // The sloping edge x + y = 4 against the corner (3, 3): 2 / sqrt(2).
    EXPECT_NEAR(distance_between(flat, moved({3, 3, 0})), std::sqrt(2.0), 1e-15);
    // A corner over the face.
    EXPECT_NEAR(distance_between(flat, {Vec3{1, 1, 0.5}, {1, 1, 3}, {2, 1, 3}}), 0.5, 1e-15);
    // Edges that cross at a distance.
    EXPECT_NEAR(distance_between(flat, {Vec3{1, -2, -1}, {1, -2, 1}, {1, -9, 0}}), 2, 1e-15);
    // Pierced.
    EXPECT_EQ(distance_between(flat, {Vec3{1, 1, -1}, {1, 1, 1}, {9, 9, 0}}), 0);
}

TEST(SectionPath, GoesTheShortestWayRoundACircle) {
    // About a square's corner (0, 0), whose edges run down and to the left: from (1, -1) straight
    // up to (1, 0), a quarter circle, then left.
    const std::vector<PlanPoint> corner{{0, -2}, {0, 0}, {-3, 0}};
    const auto curve = curve_beside(outer_hull_of({{-3, -2}, {0, -2}, {0, 0}, {-3, 0}}), 1, 64);
    const auto path = taut_path(curve, {1, -3}, -1.5);
    double length = 0;
    for (std::size_t i = 1; i < path.size(); ++i) length += glm::length(path[i] - path[i - 1]);
    // 3 up, a quarter turn in 16 chords, and 1.5 to the left.
    EXPECT_NEAR(length, 3 + 16 * 2 * std::sin(k_pi / 64) + 1.5, 1e-12);
    EXPECT_LT(glm::length(path.back() - PlanPoint(-1.5, 1)), 1e-12);
}

}  // namespace
}  // namespace culet
