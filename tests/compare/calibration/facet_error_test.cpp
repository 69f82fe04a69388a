#include "compare/calibration/facet_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"
#include "stone/solid/checks.h"

namespace culet {
namespace {

// Angle between a facet and its namesake in another solid; -1 if there is none.
double tilt(const Solid& to, const Facet& facet) {
    const int there = find_facet(to, facet.name);
    if (there < 0) return -1;
    const Vec3& n = to.facets[static_cast<std::size_t>(there)].plane.normal;
    return std::acos(std::clamp(glm::dot(n, facet.plane.normal), -1.0, 1.0));
}

// By definition. The arc cosine of a rounded 1 is up to sqrt(2 * 2^-52), at most four millionths of
// 0.2 degrees. A stone that lost a facet is left out.
TEST(FacetError, IsTheRootMeanSquareOfTheStonesTilts) {
    const double rms = radians(0.2);
    for (const char* cut : {"round-brilliant", "step"}) {
        const Solid stone = make_cut(cut);
        int whole = 0;
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            const auto wrong = with_facet_error(stone, rms, seed);
            ASSERT_TRUE(wrong.has_value());
            double squares = 0;
            bool lost = false;
            for (const Facet& facet : stone.facets) {
                const double angle = tilt(*wrong, facet);
                lost = lost || angle < 0;
                squares += angle * angle;
            }
            if (lost) continue;
            ++whole;
            EXPECT_NEAR(std::sqrt(squares / static_cast<double>(stone.facets.size())) / rms, 1,
                        1e-5)
                << cut << ' ' << seed;
        }
        EXPECT_GT(whole, 10) << cut;
    }
}

// Normally distributed angles: their mean fourth power is three times the square of their mean
// square, or 3 n / (n + 2) where the n angles of a stone are scaled to one mean square. Over 1460
// angles, with a variance of 96 for the fourth power, it is known to 0.26; four of these are 1.03.
TEST(FacetError, IsOfNormalDistribution) {
    const Solid stone = make_cut("round-brilliant");
    const double rms = radians(0.2), n = static_cast<double>(stone.facets.size());
    double fourths = 0, count = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const auto wrong = with_facet_error(stone, rms, seed);
        ASSERT_TRUE(wrong.has_value());
        for (const Facet& facet : stone.facets) {
            const double angle = tilt(*wrong, facet);
            if (angle < 0) continue;
            fourths += std::pow(angle / rms, 4);
            ++count;
        }
    }
    EXPECT_NEAR(fourths / count, 3 * n / (n + 2), 1.03);
}

TEST(FacetError, OfOneFacetTurnsItAboutItsMiddleAndLeavesTheOthers) {
    const Solid stone = make_cut("step");
    const double angle = radians(0.2);
    for (std::size_t f = 0; f < stone.facets.size(); f += 5) {
        const Facet& facet = stone.facets[f];
        Vec3 moved[2];
        for (const int axis : {0, 1}) {
            const auto wrong = with_facet_tilted(stone, f, axis, angle);
            ASSERT_TRUE(wrong.has_value());
            for (const Facet& other : stone.facets) {
                const double by = tilt(*wrong, other);
                if (by < 0) continue;
                EXPECT_NEAR(by, other.name == facet.name ? angle : 0, 1e-7) << other.name;
            }
            const int there = find_facet(*wrong, facet.name);
            ASSERT_GE(there, 0);
            const Plane& plane = wrong->facets[static_cast<std::size_t>(there)].plane;
            EXPECT_NEAR(height_above(plane, corner_mean(stone, facet)), 0, 1e-12 * diameter(stone));
            moved[axis] = plane.normal - facet.plane.normal;
        }
        // Each lies half an angle off the facet's plane: the product is at most angle^4 / 4.
        EXPECT_NEAR(glm::dot(moved[0], moved[1]), 0, std::pow(angle, 4) / 2);
    }
}

TEST(FacetError, GrowsInProportionForOneSeedAndIsNoneAtZero) {
    const Solid stone = make_cut("step");
    const auto none = with_facet_error(stone, 0, 5), small = with_facet_error(stone, 1e-4, 5),
               large = with_facet_error(stone, 3e-4, 5);
    for (const Facet& facet : stone.facets) {
        EXPECT_LT(tilt(*none, facet), 1e-7);
        const double a = tilt(*small, facet), b = tilt(*large, facet);
        // acos near 1: angles below 1e-7 are rounding error.
        if (a > 1e-5) {
            EXPECT_NEAR(b / a, 3, 1e-2);
        }
    }
}

TEST(FacetError, LeavesAClosedConvexStone) {
    for (const char* cut : {"round-brilliant", "step", "pear", "princess"}) {
        const auto wrong = with_facet_error(make_cut(cut), radians(2), 3);
        ASSERT_TRUE(wrong.has_value()) << cut;
        EXPECT_TRUE(is_convex(*wrong)) << cut;
        EXPECT_TRUE(find_faults(*wrong).empty()) << cut;
    }
}

TEST(FacetError, IsNoneOfAStoneThatIsNotConvex) {
    const Solid heart = make_cut("heart");
    EXPECT_FALSE(with_facet_error(heart, 0.01, 1).has_value());
    EXPECT_FALSE(symmetrised(heart, {0, 0, 1}).has_value());
}

TEST(TurnsAlike, OfTheStandardCuts) {
    const Vec3 up{0, 0, 1};
    EXPECT_EQ(turns_alike(make_cut("round-brilliant"), up), 8);
    EXPECT_EQ(turns_alike(make_cut("princess"), up), 4);
    EXPECT_EQ(turns_alike(make_cut("step"), up), 2);
    EXPECT_EQ(turns_alike(make_cut("oval"), up), 2);
    EXPECT_EQ(turns_alike(make_cut("trillion"), up), 3);
    EXPECT_EQ(turns_alike(make_cut("pear"), up), 1);
    EXPECT_EQ(turns_alike(*with_facet_error(make_cut("princess"), radians(0.5), 2), up), 4);
}

// The mean of 16 images (8 rotations, each also mirrored) of independent tilts of 0.3 degrees
// leaves 0.3 / 4, up to an azimuth of the whole that the group does not see.
TEST(Symmetrised, ComesNearerToTheCutThatWasSpoiled) {
    const Solid cut = make_cut("round-brilliant");
    const auto spoiled = with_facet_error(cut, radians(0.3), 7);
    const auto mended = symmetrised(*spoiled, {0, 0, 1});
    ASSERT_TRUE(mended.has_value());
    double before = 0, after = 0;
    for (const Facet& facet : cut.facets) {
        if (facet.name[0] == 'G') continue;  // slivers of the girdle may be gone
        before += std::pow(tilt(*spoiled, facet), 2);
        after += std::pow(std::max(0.0, tilt(*mended, facet)), 2);
    }
    EXPECT_LT(std::sqrt(after), 0.5 * std::sqrt(before));
    EXPECT_TRUE(is_convex(*mended));
}

TEST(Symmetrised, OfASymmetricalStoneIsNothingNew) {
    EXPECT_FALSE(symmetrised(make_cut("round-brilliant"), {0, 0, 1}).has_value());
}

}  // namespace
}  // namespace culet
