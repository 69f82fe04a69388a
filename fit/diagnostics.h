#pragma once
// How far a fit can be trusted: covariance under hard constraints, redundancy, outlier tests after
// Baarda (1968), and which freedoms no reading holds.

#include <memory>
#include <string>
#include <vector>

#include "fit/system.h"

namespace culet {

/// Standard uncertainties of one facet's freedoms and area, radians and half diameters.
struct FacetSigma {
    double inclination = 0, azimuth = 0, offset = 0, area = 0;
};

struct ReadingCheck {
    double residual = 0;    ///< fitted - value, in the reading's unit; the worst of its equations
    double normalized = 0;  ///< w = residual / (sigma sqrt(redundancy)); the worst likewise
    double redundancy = 0;  ///< 0..1, mean of its equations
    double detectable = 0;  ///< in the reading's unit
    bool suspect = false;
};

struct Diagnosis {
    std::vector<FacetSigma> facets;
    std::vector<ReadingCheck> readings;
    std::vector<int> suspects;  ///< indices of readings, in the order of their removal
    /// False for a stone too large for dense algebra: uncertainties, redundancies and normalized
    /// residuals are then NaN, suspects are not looked for, and `dof` (at most) and
    /// `undetermined_freedoms` (at least) are bounds by counting.
    bool analysed = true;
    double chi2 = 0, dof = 0;
    double suspect_limit = 0;
    std::vector<Undetermined> undetermined;
    int undetermined_freedoms = 0;
    /// Of each group of estimated uncertainty (`System::group_sigmas`): sum of squared residuals
    /// and redundancy.
    std::array<double, 2> group_squares{}, group_redundancy{};
};

struct DiagnosisOptions {
    double significance = 0.001;
    bool full = true;  ///< false: only what variance components need
};

Diagnosis diagnose(const System& system, const Shape& shape,
                   const std::shared_ptr<const Outline>& outline,
                   const DiagnosisOptions& options = {});

}  // namespace culet
