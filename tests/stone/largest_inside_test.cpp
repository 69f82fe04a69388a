#include "stone/largest_inside.h"

#include <gtest/gtest.h>

#include <cmath>

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
    // |x| + |y| + |z| <= 1 holds the cube of half edge 1/3.
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

}  // namespace
}  // namespace culet
