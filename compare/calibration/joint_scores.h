#pragma once
// The facet error that best explains several scores together, and how well it does.

#include <optional>
#include <vector>

namespace culet {

/// Draws of stones with known facet error. Scores fall with the error; a missing one is a NaN.
struct JointDraws {
    std::vector<double> levels;                           ///< logarithms of the errors, rising
    std::vector<std::vector<double>> curves;              ///< [score][level]: the expected score
    std::vector<std::vector<std::vector<double>>> draws;  ///< [level][draw][score]
};

/// Scores of one stone are correlated: three blurs of one correlation are not three independent
/// observations, and no facet error explains scores that disagree more than those of any right
/// stone.
///
/// Scores scatter about the curves with standard deviations for each level (smoothed over
/// neighbours) and one correlation matrix R: the draws' matrix mixed with the unit matrix in the
/// ratio of N draws to the number of scores (the mean of an inverse-Wishart posterior: Gelman et
/// al., Bayesian Data Analysis, 3.6). The answer minimises z' R^-1 z, with z the distances from the
/// curves in standard deviations.
class JointScores {
public:
    JointScores() = default;
    explicit JointScores(const JointDraws& draws);

    struct Answer {
        double log_error = 0;
        /// z' R^-1 z per score, relative to the draws' largest. Over 1: the scores disagree more
        /// than any right stone's.
        double misfit = 0;
    };
    /// Nothing when all scores are missing.
    std::optional<Answer> of(const std::vector<double>& scores) const;

private:
    std::optional<Answer> fitted(const std::vector<double>& scores) const;

    std::vector<double> levels_;
    std::vector<std::vector<double>> curves_, deviations_;  // [score][level]
    std::vector<double> correlations_;                      // row by row
    double largest_ = 1;
};

}  // namespace culet
