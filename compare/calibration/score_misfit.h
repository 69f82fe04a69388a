#pragma once
// Whether scores agree with each other as those of right stones do.

#include <optional>
#include <vector>

namespace culet {

/// Scores of a stone whose facet error is known, each on a scale on which it falls with the error;
/// a missing one is a NaN.
struct KnownScores {
    std::size_t level = 0;
    std::vector<double> scores;
};

/// Each score scatters about its curve with a standard deviation of each level (shared with the
/// neighbouring levels), and all together with one matrix of correlations R, of which the N draws'
/// own is mixed with the unit matrix as N to the number of scores (the mean of an inverse-Wishart
/// posterior: Gelman et al., Bayesian Data Analysis, 3.6).
class ScoreMisfit {
public:
    ScoreMisfit() = default;
    /// `levels`: rising logarithms of errors; `curves`: a score, a level.
    ScoreMisfit(std::vector<double> levels, std::vector<std::vector<double>> curves,
                const std::vector<KnownScores>& draws);

    /// z' R^-1 z a score that is not missing, z being the distances from the curves at this error
    /// in standard deviations. A score better than the curve's first level counts as that level's:
    /// it agrees with no error at all. Nothing when all are missing.
    std::optional<double> at(double log_error, const std::vector<double>& scores) const;

private:
    double standardised(std::size_t score, double value, double log_error) const;

    std::vector<double> levels_;
    std::vector<std::vector<double>> curves_, deviations_;  // a score, a level
    std::vector<double> correlations_;                      // row by row
};

}  // namespace culet
