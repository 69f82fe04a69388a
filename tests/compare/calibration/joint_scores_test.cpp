// Scores from a known law with known noise. Expectations: the law and least squares.

#include "compare/calibration/joint_scores.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/compare/calibration/scores_of_a_law.h"

namespace culet {
namespace {

using test::k_missing;

std::vector<double> scores_for(double log_error, std::mt19937_64& random) {
    return test::scores_at(log_error, 3, random);
}

JointDraws drawn_scores(int each, std::mt19937_64& random) {
    JointDraws draws;
    for (int l = 0; l < 7; ++l) draws.levels.push_back(-4 + 0.75 * l);
    draws.curves.assign(4, {});
    for (auto& curve : draws.curves)
        for (const double level : draws.levels) curve.push_back(-level);
    for (const double level : draws.levels) {
        draws.draws.emplace_back();
        for (int i = 0; i < each; ++i) draws.draws.back().push_back(scores_for(level, random));
    }
    return draws;
}

// Independent scores with noise 0.5 and 0.25 give 1 / sqrt(4 + 16) = 0.224. If the first three
// counted as independent they would outweigh the better fourth: 0.5 * 12 / 28 and 0.25 * 16 / 28
// make 0.258.
TEST(JointScores, CopiesOfAScoreCountOnce) {
    std::mt19937_64 random(7);
    const JointScores joint(drawn_scores(40, random));
    double squares = 0;
    constexpr int k_trials = 2000;
    for (int i = 0; i < k_trials; ++i) {
        const double truth = -3 + 2.0 * i / k_trials;
        const auto answer = joint.of(scores_for(truth, random));
        ASSERT_TRUE(answer);
        squares += (answer->log_error - truth) * (answer->log_error - truth);
    }
    // The root mean square of 2000 is known to 1.6 %; the bound allows three of that and lies
    // between the two.
    EXPECT_LT(std::sqrt(squares / k_trials), 0.224 * 1.08);
}

TEST(JointScores, ScoresThatDisagreeAsNoneDrawnDoHaveAMisfitOverOne) {
    std::mt19937_64 random(8);
    const JointScores joint(drawn_scores(40, random));
    EXPECT_GT(joint.of({2, 2, 0, 2})->misfit, 1);  // copies that differ by 100 times their noise
    EXPECT_LT(joint.of({2, 2, 2, 2})->misfit, 0.1);
    EXPECT_NEAR(joint.of({2, 2, 2, 2})->log_error, -2, 0.02);
    // The draws themselves define the scale.
    std::mt19937_64 again(8);
    double largest = 0;
    for (const auto& level : drawn_scores(40, again).draws)
        for (const auto& draw : level) largest = std::max(largest, joint.of(draw)->misfit);
    EXPECT_NEAR(largest, 1, 1e-9);
}

TEST(JointScores, AMissingScoreIsLeftOutAndNoneIsNoAnswer) {
    std::mt19937_64 random(9);
    const JointScores joint(drawn_scores(20, random));
    EXPECT_NEAR(joint.of({k_missing, 2, k_missing, 2})->log_error, -2, 0.02);
    EXPECT_FALSE(joint.of({k_missing, k_missing, k_missing, k_missing}));
    EXPECT_FALSE(JointScores().of({}));
}

TEST(JointScores, OfDrawsWithoutCompleteOnesTreatsScoresAsIndependent) {
    std::mt19937_64 random(10);
    JointDraws draws = drawn_scores(20, random);
    for (auto& level : draws.draws)
        for (std::size_t i = 0; i < level.size(); ++i) level[i][i % 4] = k_missing;
    const JointScores joint(draws);
    EXPECT_NEAR(joint.of({2, 2, 2, 2})->log_error, -2, 0.02);
}

}  // namespace
}  // namespace culet
