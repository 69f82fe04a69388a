#pragma once
// Finds the facet error that would lower the scores as much as the photograph's are lowered.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "compare/calibration/calibration.h"
#include "compare/calibration/error_regression.h"
#include "compare/calibration/joint_scores.h"

namespace culet {

struct ScoreKind;

/// Facet errors that are simulated, degrees, besides 0, which gives the ceiling: the best scores
/// possible.
std::vector<double> facet_errors_deg();

struct SensitivityCurve {
    std::string key;
    struct Level {
        double facet_error_deg = 0;
        int draws = 0;
        double mean = 0, sd = 0;
        double fitted = 0;  ///< monotone (isotonic regression, Barlow et al. 1972)
    };
    std::vector<Level> levels;  ///< rising error; the first is the ceiling
    bool higher_is_better = true;
    std::optional<double> value;           ///< the photograph's
    std::optional<double> equivalent_deg;  ///< where the curve has it; ends: see EquivalentError
    double weight = 0;                     ///< share in the combined answer
};

/// Degrees. The curve ends at 2; errors below `k_least_deg` cannot be told apart.
struct EquivalentError {
    std::optional<double> deg;
    double low_deg = 0,
           high_deg = 0;  ///< 95 % interval for right stones, from leave-one-out errors
    bool at_least = false, at_most = false;  ///< beyond the curve's ends
    /// For ranking: the logarithm of the error, plus log(f) / 2 if the misfit is f > 1 times the
    /// largest of right stones, as errors are scaled for large residuals (Birge 1932).
    std::optional<double> rank;
};

/// Combines several scores into an equivalent facet error, by regression on all draws with facet
/// errors (error_regression.h).
///
/// If the scores disagree more than any right stone's (joint_scores.h), instead inverts each
/// score's monotone curve in the logarithm of the error, averages the answers with weights from
/// their inverse variances for right stones of about that error, and inverts the average's own
/// curve, which removes its bias.
class FacetErrorScale {
public:
    /// Uses the calibration's draws with facet errors; `keys`: the scores that take part.
    FacetErrorScale(const Calibration& calibration, const std::vector<std::string>& keys);

    /// False when too few levels were drawn.
    bool usable() const { return curves_.size() > 0 && levels_.size() >= 3; }
    /// One for each key of the calibration.
    EquivalentError of(const std::vector<std::optional<double>>& scores) const;
    /// With the values, equivalent errors and weights of these scores.
    std::vector<SensitivityCurve> curves(const std::vector<std::optional<double>>& scores) const;
    /// The rank at the end of the scale.
    double largest_rank() const { return levels_.empty() ? 0 : levels_.back(); }

    static constexpr double k_least_deg = 0.01;  ///< stands for an error of 0

private:
    struct Curve {
        std::size_t key = 0;
        const ScoreKind* kind = nullptr;
        std::vector<double> mean, sd, fitted;  // one for each level
        std::vector<int> draws;
        std::vector<double> stabilised_scores;  // fitted, on the scale of `stabilised`
        std::vector<double> variance;  // of the log of its own equivalent error, one for each level
    };
    using DrawsByLevel = std::map<double, std::vector<const CalibrationDraw*>>;
    /// Nothing for a score that a level lacks, or that facet errors do not lower.
    std::optional<Curve> curve_of(std::size_t key, const ScoreKind& kind,
                                  const DrawsByLevel& by_level) const;
    double logarithm(const Curve& curve, double score) const;
    double weight(const Curve& curve, double log_deg) const;
    std::vector<double> stabilised_scores(const std::vector<std::optional<double>>& scores) const;
    JointDraws joint_draws(const Calibration& calibration) const;
    void fit_regression(const JointDraws& draws);
    struct Explained {
        double log_deg = 0, misfit = 0;
    };
    std::optional<Explained> explained(const std::vector<std::optional<double>>& scores) const;
    std::optional<double> averaged(const std::vector<std::optional<double>>& scores) const;

    std::vector<double> levels_;      // log degrees
    std::vector<double> levels_deg_;  // 0 for the ceiling
    std::vector<Curve> curves_;
    std::vector<double> average_;  // the average's own monotone curve, one for each level
    JointScores joint_;
    ErrorRegression regression_;
    std::vector<double> spread_;  // root mean square error of the answers, one for each level
};

}  // namespace culet
