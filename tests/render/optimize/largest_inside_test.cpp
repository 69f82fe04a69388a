#include "render/optimize/largest_inside.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "stone/cuts/cuts.h"

namespace culet {
namespace {

Solid box(const Vec3& middle, const Vec3& half) {
    std::vector<NamedPlane> planes;
    for (int k = 0; k < 3; ++k) {
        for (const double side : {-1.0, 1.0}) {
            Vec3 normal{0};
            normal[k] = side;
            planes.push_back({"f", {normal, side * middle[k] + half[k]}});
        }
    }
    return intersect_half_spaces(planes).solid;
}

TEST(LargestInside, OfACubeInABoxIsAsWideAsItsNarrowestSide) {
    const LargestInside inside =
        largest_inside(box({0, 0, 0}, {1, 1, 1}), box({3, -2, 5}, {2, 0.5, 4}));
    EXPECT_NEAR(inside.scale, 0.5, 1e-15);
    EXPECT_NEAR(inside.volume, 1, 1e-14);
    EXPECT_NEAR(inside.shift.y, -2, 1e-14);
}

TEST(LargestInside, OfACubeInAnOctahedronTouchesItsFacetsWithItsCorners) {
    std::vector<NamedPlane> planes;
    for (int i = 0; i < 8; ++i) {
        const Vec3 normal = Vec3{i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1} / std::sqrt(3.0);
        planes.push_back({"f", {normal, 1 / std::sqrt(3.0)}});
    }
    // |x| + |y| + |z| <= 1 holds a cube of half edge 1/3.
    const LargestInside inside =
        largest_inside(box({0, 0, 0}, {1, 1, 1}), intersect_half_spaces(planes).solid);
    EXPECT_NEAR(inside.scale, 1.0 / 3, 1e-14);
    const Solid moved = moved_inside(box({0, 0, 0}, {1, 1, 1}), inside);
    EXPECT_NEAR(volume(moved), 8.0 / 27, 1e-13);
}

TEST(LargestInside, OfASolidInItselfIsItself) {
    const Solid solid = box({1, 2, 3}, {1, 2, 3});
    const LargestInside inside = largest_inside(solid, solid);
    EXPECT_NEAR(inside.scale, 1, 1e-14);
    EXPECT_NEAR(inside.volume, volume(solid), 1e-12);
}

// The scale of the largest copy with its centroid at `place`, limited by the nearest plane.
double scale_at(const Vec3& place, const Solid& cut, const Solid& stone) {
    double scale = std::numeric_limits<double>::infinity();
    const Vec3 middle = centroid(cut);
    for (const Facet& facet : stone.facets) {
        double furthest = 0;
        for (const Vec3& vertex : cut.vertices)
            furthest = std::max(furthest, glm::dot(facet.plane.normal, vertex - middle));
        scale =
            std::min(scale, (facet.plane.offset - glm::dot(facet.plane.normal, place)) / furthest);
    }
    return scale;
}

// The scale is a concave function of the place: a local maximum is the global one. Most of a
// brilliant's planes touch the copy at once, which misleads a careless simplex method.
TEST(LargestInside, OfBrilliantsInABrilliantGrowsInNoDirection) {
    const Solid stone = make_cut("round-brilliant");
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int trial = 0; trial < 100; ++trial) {
        const Solid cut = make_cut("round-brilliant", {{"crown-angle", 34.5 + unit(random)},
                                                       {"pavilion-angle", 40.8 + unit(random)},
                                                       {"table", 56 + unit(random)}});
        const LargestInside inside = largest_inside(cut, stone);
        const Vec3 place = inside.shift + inside.scale * centroid(cut);
        EXPECT_NEAR(scale_at(place, cut, stone), inside.scale, 1e-11);
        for (int step = 0; step < 50; ++step) {
            const Vec3 moved = place + 1e-3 * Vec3{unit(random), unit(random), unit(random)};
            EXPECT_LE(scale_at(moved, cut, stone), inside.scale + 1e-11);
        }
    }
}

}  // namespace
}  // namespace culet
