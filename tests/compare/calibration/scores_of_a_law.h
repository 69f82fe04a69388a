#pragma once
// Scores from a known law with known noise, for tests that estimate facet errors from several
// scores.

#include <limits>
#include <random>
#include <vector>

namespace culet::test {

constexpr double k_missing = std::numeric_limits<double>::quiet_NaN();

/// Scores fall by 1 as the logarithm grows by 1. The first ones share one noise of 0.5; the last
/// has an independent noise of 0.25.
inline std::vector<double> scores_at(double log_error, int sharing, std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    const double shared = 0.5 * normal(random);
    std::vector<double> scores;
    for (int k = 0; k < sharing; ++k) scores.push_back(-log_error + shared + 0.02 * normal(random));
    scores.push_back(-log_error + 0.25 * normal(random));
    return scores;
}

}  // namespace culet::test
