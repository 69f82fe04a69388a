// Scores from a known law with known noise. Expectation: the result of least squares.

#include "compare/calibration/error_regression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/compare/calibration/scores_of_a_law.h"

namespace culet {
namespace {

using test::k_missing;

std::vector<double> scores_at(double log_error, std::mt19937_64& random) {
    return test::scores_at(log_error, 2, random);
}

ErrorRegression drawn(int count, std::mt19937_64& random) {
    std::vector<double> errors;
    std::vector<std::vector<double>> scores;
    for (int i = 0; i < count; ++i) {
        errors.push_back(-4 + 4.0 * (i % 9) / 8);
        scores.push_back(scores_at(errors.back(), random));
    }
    return ErrorRegression(errors, scores);
}

double root_mean_square(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v * v;
    return std::sqrt(sum / static_cast<double>(values.size()));
}

// Independent scores with noise 0.5 and 0.25 give 1 / sqrt(4 + 16) = 0.224, slightly less because
// the distribution of errors (uniform, deviation 1.29) is informative too. Four weights from 72
// draws cost 3 %; the root mean square of 2000 is known to 1.6 %, that of 72 to 8 %; the bounds are
// three of each.
TEST(ErrorRegression, IsAsGoodAsItsIndependentScoresAndSaysHowGood) {
    std::mt19937_64 random(7);
    const ErrorRegression regression = drawn(72, random);
    std::vector<double> off;
    for (int i = 0; i < 2000; ++i) {
        const double truth = -4 + 4.0 * i / 2000;
        const auto answer = regression.of(scores_at(truth, random));
        ASSERT_TRUE(answer);
        off.push_back(*answer - truth);
    }
    EXPECT_LT(root_mean_square(off), 0.224 * 1.08);
    EXPECT_NEAR(root_mean_square(regression.left_out()) / root_mean_square(off), 1, 0.3);
}

TEST(ErrorRegression, WithoutAScoreAsksTheOthers) {
    std::mt19937_64 random(8);
    const ErrorRegression regression = drawn(72, random);
    // The third alone has noise of 0.25, the first of 0.5.
    EXPECT_NEAR(*regression.of({k_missing, k_missing, 2}), -2, 0.2);
    EXPECT_NEAR(*regression.of({2, k_missing, k_missing}), -2, 0.4);
    EXPECT_FALSE(regression.of({k_missing, k_missing, k_missing}));
}

TEST(ErrorRegression, OfTooFewDrawsHasNoAnswer) {
    EXPECT_FALSE(ErrorRegression().of({1}));
    EXPECT_FALSE(ErrorRegression({0, 1}, {{0}, {1}}).of({1}));
}

TEST(ErrorRegression, OfScoresThatDoNotVaryIsTheMean) {
    EXPECT_NEAR(*ErrorRegression({0, 1, 2}, {{5}, {5}, {5}}).of({5}), 1, 1e-9);
}

}  // namespace
}  // namespace culet
