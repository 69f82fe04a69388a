#include "render/optics/stokes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace culet {
namespace {

double distance(const Stokes& a, const Stokes& b) {
    return std::hypot(std::hypot(a[0] - b[0], a[1] - b[1]), std::hypot(a[2] - b[2], a[3] - b[3]));
}

// The properties of a projection onto a convex set: the result is in the set, members of the set
// stay, and no member of the set is farther from the result than from the projected point.
TEST(Stokes, NearestLightIsLightAndNoFartherFromAnyOther) {
    std::mt19937_64 random(20261122);
    std::normal_distribution<double> normal;
    const double h = 2.220446049250313e-16;
    for (int i = 0; i < 2000; ++i) {
        const Stokes estimate{normal(random), normal(random), normal(random), normal(random)};
        const Stokes light = nearest_light(estimate);
        const double polarised = std::hypot(light[1], light[2], light[3]);
        EXPECT_LE(polarised, light[0] * (1 + 4 * h));
        Stokes other{0, normal(random), normal(random), normal(random)};
        other[0] = std::hypot(other[1], other[2], other[3]) * (1 + std::abs(normal(random)));
        EXPECT_EQ(nearest_light(other), other);
        EXPECT_LE(distance(light, other), distance(estimate, other) * (1 + 8 * h));
    }
}

TEST(Stokes, LessLightThanNoneIsNone) {
    EXPECT_EQ(nearest_light({-0.001, 0, 0, 0}), (Stokes{0, 0, 0, 0}));
    EXPECT_EQ(nearest_light({-0.5, 0.3, 0, -0.4}), (Stokes{0, 0, 0, 0}));
    EXPECT_EQ(nearest_light({0, 0, 0, 0}), (Stokes{0, 0, 0, 0}));
    // Half way between: S0 = 0 with 1 polarised is nearest to (1/2; 1/2).
    EXPECT_EQ(nearest_light({0, 0, 1, 0}), (Stokes{0.5, 0, 0.5, 0}));
}

}  // namespace
}  // namespace culet
