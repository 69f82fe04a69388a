#pragma once
// What a photograph's scores mean: the equivalent facet error, and the distance from chance.

#include <optional>
#include <string>
#include <vector>

#include "compare/calibration/calibration.h"
#include "compare/calibration/sensitivity.h"
#include "compare/scores/score.h"

namespace culet {

struct NullStatistics {
    Alternative alternative = Alternative::light;
    int draws = 0;
    double mean = 0, sd = 0;  ///< of zncc
    double z = 0;             ///< of atanh, see `fill_null`
    /// Draws whose equivalent facet error is no larger than the photograph's, and the p-value
    /// (as_good + 1) / (draws + 1).
    int as_good = 0;
    double p = 1;
    /// Smallest and median equivalent facet error of the null's draws, degrees.
    double least_deg = 0, median_deg = 0;
};

struct HypothesisScore {
    Alternative alternative = Alternative::wrong;
    std::string name;
    std::optional<double> zncc;
    EquivalentError equivalent;
};

struct CalibratedVerdict {
    Verdict verdict = Verdict::no_evidence;
    /// "The photograph agrees with this stone: as well as with facets off by 0.2 degrees (0.17 to
    /// 0.24); 0 of 12 wrong lights agree as well".
    std::string headline;
    EquivalentError equivalent;
    std::vector<SensitivityCurve> curves;  ///< one for each score that takes part
    std::vector<NullStatistics> nulls;     ///< smallest z first
    std::vector<HypothesisScore> hypotheses;
    bool geometry_only = false;  ///< the photograph cannot serve for photometry
    Calibration calibration;
    /// Minus the logarithm of the scores' mean answer (degrees): unbounded, for ranking photographs
    /// of one calibration.
    double evidence = 0;
};

extern const char* const k_calibrated_rule;

/// `scores`: photograph against model's render, at the calibration's size.
CalibratedVerdict calibrated_verdict(const std::vector<Score>& scores, Calibration calibration,
                                     bool geometry_only = false);

}  // namespace culet
