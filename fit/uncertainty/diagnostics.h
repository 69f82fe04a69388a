#pragma once
// How far a fit can be trusted: covariance under hard constraints, redundancy, outlier tests after
// Baarda (1968), and which parameters no reading holds.

#include <memory>
#include <string>
#include <vector>

#include "fit/model/fit_model.h"
#include "fit/model/undetermined.h"
#include "fit/solve/free_meets.h"

namespace culet {

class Covariance;

/// Standard uncertainties of one facet's parameters and area, radians and half diameters.
struct FacetSigma {
    double inclination = 0, azimuth = 0, offset = 0, area = 0;
    /// Of the first three: what part the readings have in them (FittedFacet).
    std::array<double, 3> read{1, 1, 1};
};

struct ReadingCheck {
    double residual = 0;    ///< fitted - value, in the reading's unit; the worst of its equations
    double normalized = 0;  ///< w = residual / (sigma sqrt(redundancy)); the worst likewise
    double redundancy = 0;  ///< 0..1, mean of its equations
    double detectable = 0;  ///< in the reading's unit
    bool suspect = false;
};

/// A reading that stands out, and what the others say it should have been.
struct Suspicion {
    int reading = -1;
    double estimate = 0, sigma = 0;  ///< of its value from the others; its unit
    std::vector<int> alternatives;   ///< readings that would explain the misfit as well
};

struct Diagnosis {
    std::vector<FacetSigma> facets;
    /// Of all facets' inclinations, azimuths and offsets, row by row, three a facet; radians and
    /// half diameters. A level facet's azimuth has none: 0. Open directions count with the mesh's
    /// own uncertainty, as in the sigmas. Empty: not known, or of
    /// more than 300 facets.
    std::vector<double> facet_covariance;
    std::vector<ReadingCheck> readings;
    std::vector<int> suspects;          ///< indices of readings, the gravest first
    std::vector<Suspicion> suspicions;  ///< one each
    /// An irreducible set of readings that cannot hold together, where chi2 fails or exact readings
    /// contradict each other.
    std::vector<int> disagreeing;
    /// False when the equations could not be factored: uncertainties, redundancies and normalized
    /// residuals are then NaN, suspects are not looked for, and `dof` (at most) and
    /// `rank_defect` (at least) are bounds by counting.
    bool analysed = true;
    std::shared_ptr<const Covariance> covariance;  ///< of the unknowns; null for `full` = false
    double chi2 = 0, dof = 0;
    double suspect_limit = 0;
    std::vector<Undetermined> undetermined;
    int rank_defect = 0;
    /// Of each group of estimated uncertainty (`FitModel::group_sigmas`): sum of squared residuals
    /// and redundancy.
    std::array<double, 2> group_squares{}, group_redundancy{};
};

struct DiagnosisOptions {
    double significance = 0.001;
    bool full = true;  ///< false: only what variance components need
    /// Corners that the fit holds, each of which costs the readings a freedom: given which bounds
    /// bind, chi-square has so many degrees of freedom more (Silvapulle & Sen 2005, chapter 3).
    int binding = 0;
};

Diagnosis diagnose(const FitModel& model, const Shape& shape,
                   const std::shared_ptr<const Outline>& outline,
                   const DiagnosisOptions& options = {});

}  // namespace culet
