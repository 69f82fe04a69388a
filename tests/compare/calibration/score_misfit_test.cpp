// Scores made by a known law with known noise: what the law gives is the expectation.

#include "compare/calibration/score_misfit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/compare/calibration/scores_of_a_law.h"

namespace culet {
namespace {

using test::k_missing;

const std::vector<double> k_levels{-4, -3, -2, -1, 0};
const std::vector<double> k_falling{4, 3, 2, 1, 0};

// Three scores share a noise of 0.5 and differ by 0.02; the fourth has 0.25 of its own.
TEST(ScoreMisfit, OfCopiesThatDisagreeIsOverThatOfAllDraws) {
    std::mt19937_64 random(8);
    std::vector<KnownScores> draws;
    for (std::size_t l = 0; l < k_levels.size(); ++l) {
        for (int i = 0; i < 40; ++i) draws.push_back({l, test::scores_at(k_levels[l], 3, random)});
    }
    const ScoreMisfit misfit(k_levels, {4, k_falling}, draws);
    double largest = 0;
    for (const KnownScores& draw : draws)
        largest = std::max(largest, *misfit.at(k_levels[draw.level], draw.scores));
    EXPECT_GT(*misfit.at(-2, {2, 2, 0, 2}), 2 * largest);  // copies 100 of their noises apart
    EXPECT_LT(*misfit.at(-2, {3, 3, 3, 2}), largest);      // all three two of theirs off
    EXPECT_LT(*misfit.at(-2, {2, 2, 2, 2}), 0.01);
}

// No draw has both scores, so that nothing is known of how they go together.
TEST(ScoreMisfit, OfIndependentScoresIsTheMeanSquareInStandardDeviations) {
    std::vector<KnownScores> draws;
    for (std::size_t l = 0; l < k_levels.size(); ++l) {
        for (const double side : {-1.0, 1.0}) {
            draws.push_back({l, {k_falling[l] + 0.5 * side, k_missing}});
            draws.push_back({l, {k_missing, k_falling[l] + 0.25 * side}});
        }
    }
    const ScoreMisfit misfit(k_levels, {k_falling, k_falling}, draws);
    EXPECT_NEAR(*misfit.at(-1.5, {1.5 + 0.5, 1.5 - 0.5}), (1 + 4) / 2.0, 1e-12);
    EXPECT_NEAR(*misfit.at(-1.5, {k_missing, 1.5 - 0.5}), 4, 1e-12);
    EXPECT_FALSE(misfit.at(-1.5, {k_missing, k_missing}));
    EXPECT_FALSE(ScoreMisfit().at(-1.5, {}));
}

}  // namespace
}  // namespace culet
