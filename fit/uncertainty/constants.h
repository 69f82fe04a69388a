#pragma once
// The numbers of the uncertainties and the tests: unit, meaning, and where each comes from. Lengths
// are in half diameters, gains in chi-square; numbers without a bench lie far between the two sizes
// that they tell apart. Private to the room.

#include <Eigen/Core>
#include <cstddef>

namespace culet {

/// Covariances (covariance.h).
struct CovarianceConstants {
    /// Of open directions in tests, in the metric: so much more than anything that is measured that
    /// they take no part. A prior of its inverse changes no digit that is told.
    double unheld_variance = 1e3;
    /// Dense algebra grows with the cube of the unknowns; beyond this many it is the slower one.
    Eigen::Index most_dense = 1300;
    /// Normal equations square the spread of weights. Nothing that is held is so at less than a
    /// weight of 2: beyond this, QR keeps what they lose.
    double most_spread = 1e5;
    /// Of motions that nothing sees, so that they count as held.
    double least_of_gauge = 1e3;
    /// Of all variances together: what is told of them has three digits.
    double precision = 1e-6;
    /// A row of more entries than this touches more than a few facets and their corners.
    Eigen::Index long_row = 90;
    /// With more long rows than this, keeping them apart costs more than the fill that they make.
    std::size_t most_long = 48;
    /// A miss of less variance is rounding: other hard equations hold the condition.
    double rounding_variance = 1e-18;
    /// Of a condition's variance, what is left given the others: with less it repeats them.
    double least_own = 1e-10;
};
inline constexpr CovarianceConstants k_cov;

/// Redundancy and what is told of it (diagnostics.h).
struct CheckConstants {
    /// A redundancy this small is rounding: nothing checks the equation.
    double no_redundancy = 1e-6;
    /// An error of size limit + 0.84 sigma is found in 80 of 100 cases.
    double power_80 = 0.8416212335729143;
    /// Of more facets the matrix would be larger than anybody's use for it.
    std::size_t most_facets_together = 300;
};
inline constexpr CheckConstants k_checks;

/// Wrong readings (snooping.h, inconsistent_subset.h, suspects.h).
struct SnoopingConstants {
    /// Redundancy below which an equation cannot be checked.
    double least_tested = 1e-4;
    /// How many of the most conspicuous equations are tried as one half of a pair.
    std::size_t pair_candidates = 40;
    /// The search ends where so many are left out and a tenth of the rest stands out still; or
    /// here.
    std::size_t few = 8, many = 40;
    /// Twice the log of the likelihood ratio below which two explanations are as good as each
    /// other.
    double alternative = 3;
    /// More equations are not searched for an irreducible set that disagrees: the hat matrix and
    /// its updates would take minutes.
    Eigen::Index most_equations = 1500;
    double same_part = 1e-6;  ///< in sigmas
};
inline constexpr SnoopingConstants k_snooping;

/// Evidence on meets beside a prior (meet_evidence.h).
struct EvidenceConstants {
    /// Sizes that are looked at, of the usual miss: up to 2 % of the width, where meets hold
    /// nothing any more. Finer than a factor of 1.25 no sigma is known by a hundred readings.
    double least_part = 0.02, most_part = 20, ratio = 1.25;
    /// The largest size that the readings allow is taken, within one standard error of the
    /// likeliest: a sigma that is too small pulls planes off good readings, one that is too large
    /// forgoes a little.
    double allowed = 1;
    /// Meets that miss by less are exact: 0.01 % of the width turns a facet of a sixth of it by
    /// 0.03 degrees, which no goniometer shows.
    double exact_part = 0.1;
    /// Rounds of estimate and fit; a change of less is of no matter.
    int rounds = 3;
    double same = 0.1;
};
inline constexpr EvidenceConstants k_evidence;

/// Estimates of how far meets miss (meet_sigmas.h).
struct MeetSizeConstants {
    /// Rounding is the least that anything can miss by.
    double least_sigma = 1e-9;
    /// The scan: sizes of misses in the scale of the fit, half a power of ten apart.
    double scan_from = 1e-7, scan_to = 0.11, scan_step = 3.1622776601683795;
    /// Another hill, not rounding: a likelihood ratio of e.
    double another = 1;
    /// Ends nearer than this in the logarithm of every sigma are one.
    double same_end = 0.05;
    int most_ends = 4;
};
inline constexpr MeetSizeConstants k_meet_size;

/// Whether a prior is needed (prior_needed.h).
struct PriorNeedConstants {
    /// Freedoms of a polyhedron of E edges, less E: six, four of which move it as a whole.
    int shape = 2;
    /// Who read three quarters of it did not read for an evening only: the fit may do without.
    double part_read = 0.75;
    std::size_t many_facets = 150;  ///< facets; there one would wait for it
    int few_open = 4;               ///< directions: a rough mesh shows some that are none
};
inline constexpr PriorNeedConstants k_needed;

}  // namespace culet
