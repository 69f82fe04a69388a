#include "fit/fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "stone/checks.h"
#include "stone/errors.h"
#include "tests/fit/test_stones.h"

namespace culet {
namespace {

using namespace test;

void expect_sound(const FitResult& result) {
    EXPECT_TRUE(result.closed);
    EXPECT_TRUE(result.convex);
    EXPECT_LT(result.planarity_max, 1e-12 * diameter(result.solid));
    EXPECT_THAT(find_faults(result.solid), ::testing::IsEmpty());
}

TEST(TestStones, BrilliantHasTheKnownCounts) {
    const Solid solid = brilliant();
    EXPECT_EQ(solid.facets.size(), 73u);
    EXPECT_EQ(solid.vertices.size(), 57u);
    EXPECT_EQ(edge_count(solid), 128);
    EXPECT_TRUE(is_closed(solid));
    EXPECT_TRUE(is_convex(solid));
}

// Without noise the truth is the optimum, whatever the start.
TEST(Fit, RecoversAShakenBrilliant) {
    const Solid truth = brilliant();
    std::vector<Reading> readings = all_angles(truth, radians(0.1), "T");
    for (const Reading& r : all_edges(truth, 0.01)) readings.push_back(r);
    readings.push_back(depth(truth, 0.01));
    for (int k = 0; k < 8; ++k) readings.push_back(width(truth, 22.5 * k, 0.01));
    for (const double noise : {0.01, 0.1, 0.2}) {
        const FitResult result = fit_stone(stone_of(shaken(truth, noise, 3)), readings);
        EXPECT_EQ(result.status, FitStatus::converged) << noise << ": " << result.message;
        EXPECT_LT(result.chi2, 1e-6) << noise;
        expect_sound(result);
        for (std::size_t f = 0; f < truth.facets.size(); ++f) {
            EXPECT_NEAR(area(result.solid, result.solid.facets[f]), area(truth, truth.facets[f]),
                        1e-6)
                << truth.facets[f].name << " at " << noise;
        }
    }
}

}  // namespace
}  // namespace culet
