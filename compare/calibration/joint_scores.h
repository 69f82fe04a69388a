#pragma once
// What facet error explains several scores together, and how well it does.

#include <optional>
#include <vector>

namespace culet {

/// Draws of stones whose facet error is known. Scores are on scales on which they fall with the
/// error; a missing one is a NaN.
struct JointDraws {
    std::vector<double> levels;               ///< logarithms of the errors, rising
    std::vector<std::vector<double>> curves;  ///< a score, a level: where the score lies there
    std::vector<std::vector<std::vector<double>>> draws;  ///< a level, a draw, a score
};

/// Scores of one stone go up and down together: three blurs of one correlation are not three
/// witnesses, and scores that disagree as they never do for right stones are not explained by any
/// facet error. Each level's scores scatter about the curves with their own standard deviations
/// (shared with the neighbouring levels) and with one matrix of correlations R for all levels, of
/// which the N draws' own is mixed with the unit matrix as N to the number of scores (the mean of
/// an inverse-Wishart posterior: Gelman et al., Bayesian Data Analysis, 3.6). The answer is the
/// error at which z' R^-1 z is least, z being the scores' distances from the curves in standard
/// deviations.
class JointScores {
public:
    JointScores() = default;
    explicit JointScores(const JointDraws& draws);

    struct Answer {
        double log_error = 0;
        /// z' R^-1 z a score, over the largest of the draws: over 1, no right stone that was drawn
        /// has scores that agree so badly.
        double misfit = 0;
    };
    /// Nothing when all scores are missing.
    std::optional<Answer> of(const std::vector<double>& scores) const;

private:
    std::optional<Answer> fitted(const std::vector<double>& scores) const;

    std::vector<double> levels_;
    std::vector<std::vector<double>> curves_, deviations_;  // a score, a level
    std::vector<double> correlations_;                      // row by row
    double largest_ = 1;
};

}  // namespace culet
