// Expectations: closed forms, and points counted on a grid.

#include "render/beams/disc_in_part.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace culet;
using Polygon = std::vector<ScreenPoint>;

double share(const Polygon& polygon, double radius) {
    return share_in_circle(polygon.data(), polygon.size(), radius);
}
Polygon square_at(double x, double y) {
    return {{x - 1, y - 1}, {x + 1, y - 1}, {x + 1, y + 1}, {x - 1, y + 1}};
}

TEST(ShareInCircle, OfASquareHasClosedForms) {
    const double pi = std::numbers::pi;
    EXPECT_NEAR(share(square_at(0, 0), 0.5), pi * 0.25 / 4, 1e-14) << "the whole circle";
    EXPECT_NEAR(share(square_at(0, 0), 1.5), 1, 1e-14) << "all of the square";
    EXPECT_NEAR(share(square_at(1, 0), 0.5), pi * 0.25 / 8, 1e-14) << "half, at a side";
    EXPECT_NEAR(share(square_at(1, 1), 0.5), pi * 0.25 / 16, 1e-14) << "a quarter, at a corner";
    EXPECT_EQ(share(square_at(3, 0), 0.5), 0) << "beside it";
    // Less four segments, each r^2 acos(d / r) - d sqrt(r^2 - d^2).
    const double r = 1.2, segment = r * r * std::acos(1 / r) - std::sqrt(r * r - 1);
    EXPECT_NEAR(share(square_at(0, 0), r), (pi * r * r - 4 * segment) / 4, 1e-14);
}

TEST(ShareInCircle, OfRandomPolygonsIsThatOfPointsAndOfTheirMirrorImages) {
    std::mt19937_64 random(20269);
    std::uniform_real_distribution<double> unit(-1, 1), size(0.2, 2);
    for (int i = 0; i < 100; ++i) {
        SCOPED_TRACE("seed 20269, polygon " + std::to_string(i));
        const ScreenPoint middle{unit(random), unit(random)};
        std::vector<double> angles(5);
        for (double& angle : angles) angle = std::numbers::pi * unit(random);
        std::sort(angles.begin(), angles.end());
        Polygon polygon;
        for (const double angle : angles)
            polygon.push_back({middle.x + std::cos(angle), middle.y + 0.6 * std::sin(angle)});
        const double radius = size(random);
        constexpr int k_points = 400;
        int in = 0, all = 0;
        for (int k = 0; k < k_points * k_points; ++k) {
            const ScreenPoint p{middle.x + 2 * (k % k_points + 0.5) / k_points - 1,
                                middle.y + 2 * (k / k_points + 0.5) / k_points - 1};
            bool within = true;
            for (std::size_t a = polygon.size() - 1, b = 0; b < polygon.size(); a = b++) {
                within &= (polygon[b].x - polygon[a].x) * (p.y - polygon[a].y) -
                              (polygon[b].y - polygon[a].y) * (p.x - polygon[a].x) >=
                          0;
            }
            all += within;
            in += within && std::hypot(p.x, p.y) < radius;
        }
        const double found = share(polygon, radius);
        // Points are 0.005 apart. Along borders of length 10, every second point may be on the
        // wrong side at worst; by chance it is their square root.
        if (all > 1000) {
            EXPECT_NEAR(found, static_cast<double>(in) / all, 100.0 / all);
        }
        std::reverse(polygon.begin(), polygon.end());
        EXPECT_NEAR(share(polygon, radius), found, 1e-12);
    }
}

TEST(ShareInCircle, OfNoAreaIsNothing) {
    EXPECT_EQ(share({{0, 0}, {1, 0}, {2, 0}}, 1), 0);
    EXPECT_EQ(share({{0, 0}, {0, 0}, {0, 0}}, 1), 0);
}

}  // namespace
