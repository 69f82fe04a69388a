#pragma once
// How far a fit can be trusted: covariance, redundancy, outlier tests after Baarda (1968),
// undetermined parameters.

#include <memory>
#include <string>
#include <vector>

#include "fit/model/fit_model.h"
#include "fit/model/undetermined.h"
#include "fit/solve/free_meets.h"

namespace culet {

class Covariance;

/// Standard uncertainties of one facet, in radians and half diameters.
struct FacetSigma {
    double inclination = 0, azimuth = 0, offset = 0, area = 0;
    /// Part of the first three that comes from readings (FittedFacet).
    std::array<double, 3> read{1, 1, 1};
};

struct ReadingCheck {
    double residual = 0;    ///< fitted - value, in the reading's unit; of its worst equation
    double normalized = 0;  ///< w = residual / (sigma sqrt(redundancy)); of its worst equation
    double redundancy = 0;  ///< 0..1, mean of its equations
    double detectable = 0;  ///< smallest error that is found in 80 of 100 cases; the reading's unit
    bool suspect = false;
};

struct Suspicion {
    int reading = -1;
    double estimate = 0, sigma = 0;  ///< from the others, in its unit
    std::vector<int> alternatives;   ///< readings that would explain the misfit as well
};

struct Diagnosis {
    std::vector<FacetSigma> facets;
    /// As FitResult::facet_covariance, with offsets in half diameters. A level facet's azimuth has
    /// 0; unobservable directions have the mesh's own uncertainty, as in the sigmas.
    std::vector<double> facet_covariance;
    std::vector<ReadingCheck> readings;
    std::vector<int> suspects;          ///< indices of readings, the worst first
    std::vector<Suspicion> suspicions;  ///< one for each suspect
    /// An irreducible inconsistent set, if chi2 fails or exact readings contradict each other.
    std::vector<int> disagreeing;
    /// False if the equations could not be factored. Then sigmas, redundancies and normalized
    /// residuals are NaN, there are no suspects, and `dof` (at most) and `rank_defect` (at least)
    /// are bounds from counting.
    bool analysed = true;
    std::shared_ptr<const Covariance> covariance;  ///< of the unknowns; null for `full` = false
    double chi2 = 0, dof = 0;
    double suspect_limit = 0;
    std::vector<Undetermined> undetermined;
    int rank_defect = 0;
    /// By group of estimated uncertainty (`FitModel::group_sigmas`): sum of squared residuals,
    /// redundancy.
    std::array<double, 2> group_squares{}, group_redundancy{};
};

struct DiagnosisOptions {
    double significance = 0.001;
    bool full = true;  ///< false: only what variance components need
    /// Number of held corners: each active bound adds a degree of freedom to chi-square (Silvapulle
    /// & Sen 2005, chapter 3).
    int binding = 0;
};

Diagnosis diagnose(const FitModel& model, const Shape& shape,
                   const std::shared_ptr<const Outline>& outline,
                   const DiagnosisOptions& options = {});

}  // namespace culet
