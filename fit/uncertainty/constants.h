#pragma once
// Constants of the uncertainties and tests: unit, meaning, and the bench they come from. Lengths
// are in half diameters, gains in chi-square. A constant without a bench lies far between the two
// sizes that it separates. Private to the room.

#include <Eigen/Core>
#include <cstddef>

namespace culet {

/// Covariances (covariance.h).
struct CovarianceConstants {
    /// Variance of undetermined directions in tests, in the metric: so much larger than any
    /// measured one that they do not count. A prior of its inverse changes no digit of a report.
    double undetermined_variance = 1e3;
    /// Unknowns. With more, sparse algebra is faster than dense.
    Eigen::Index most_dense = 1300;
    /// Spread of weights up to which the normal equations are used. They square it; above, QR keeps
    /// the digits that they lose. Determined directions have weights of 2 or more.
    double most_spread = 1e5;
    /// Least weight of motions that no reading sees, so that they count as determined.
    double least_of_gauge = 1e3;
    /// Allowed error in the sum of all relative variances. Reports have three digits.
    double precision = 1e-6;
    /// Entries. A longer row depends on more than a few facets and their corners.
    Eigen::Index long_row = 90;
    /// Long rows that are kept apart. With more, this costs more than the fill they cause.
    std::size_t most_long = 48;
    /// A condition with a smaller variance holds by other exact equations; its misfit is rounding.
    double rounding_variance = 1e-18;
    /// Part of a condition's variance that the other conditions leave. With less, it repeats them.
    double least_own = 1e-10;
};
inline constexpr CovarianceConstants k_cov;

/// Redundancy and what is told of it (diagnostics.h).
struct CheckConstants {
    /// Below this redundancy, which is rounding, nothing checks the equation.
    double no_redundancy = 1e-6;
    /// An error of limit + 0.84 sigma is found in 80 of 100 cases (normal quantile of 0.8).
    double power_80 = 0.8416212335729143;
    /// Facets. With more, the joint covariance of all facets is too large to be useful.
    std::size_t most_facets_together = 300;
};
inline constexpr CheckConstants k_checks;

/// Wrong readings (snooping.h, inconsistent_subset.h, suspects.h).
struct SnoopingConstants {
    /// An equation with less redundancy cannot be tested.
    double least_tested = 1e-4;
    /// Equations, the largest w first, that are tried as one half of a pair.
    std::size_t pair_candidates = 40;
    /// The search stops when this many are left out and a tenth of the rest still stands out; at
    /// the latest at `many`.
    std::size_t few = 8, many = 40;
    /// Twice the logarithm of a likelihood ratio. Explanations that differ by less are as good as
    /// each other.
    double alternative = 3;
    /// With more equations no irreducible inconsistent subset is searched for: the hat matrix and
    /// its updates would take minutes.
    Eigen::Index most_equations = 1500;
    double same_part = 1e-6;  ///< in sigmas
};
inline constexpr SnoopingConstants k_snooping;

/// Evidence on meets beside a prior (meet_evidence.h).
struct EvidenceConstants {
    /// Sizes of the misses that are tried, relative to the usual one: up to 2 % of the width, where
    /// meets no longer hold anything, in steps as fine as a hundred readings can tell apart.
    double least_part = 0.02, most_part = 20, ratio = 1.25;
    /// Standard errors. The largest size this near to the likeliest is taken: too small a sigma
    /// pulls planes off good readings, too large a one loses a little precision.
    double allowed = 1;
    /// Meets that miss by less are exact: 0.01 % of the width turns a facet of a sixth of the width
    /// by 0.03 degrees, which no goniometer shows.
    double exact_part = 0.1;
    /// Rounds of estimate and fit; they end when the estimate changes by less than `same`.
    int rounds = 3;
    double same = 0.1;
};
inline constexpr EvidenceConstants k_evidence;

/// Estimates of how far meets miss (meet_sigmas.h).
struct MeetSizeConstants {
    /// Rounding: no meet can be known to miss by less.
    double least_sigma = 1e-9;
    /// The sizes that are scanned, in factors of the root of ten.
    double scan_from = 1e-7, scan_to = 0.11, scan_step = 3.1622776601683795;
    /// Difference in log likelihood by which a second maximum is one, and not rounding.
    double another = 1;
    /// Solutions whose sigmas differ by less, in the logarithm, are one.
    double same_solution = 0.05;
    int most_solutions = 4;
};
inline constexpr MeetSizeConstants k_meet_size;

/// Whether a prior is needed (prior_needed.h).
struct PriorNeedConstants {
    /// Parameters of a polyhedron with E edges, less E, less the four that move it: a turn about
    /// `up` and a shift.
    int shape = 2;
    /// Part of the parameters that were read. Above it the readings count as complete, and the fit
    /// may do without a prior.
    double part_read = 0.75;
    std::size_t many_facets = 150;  ///< facets; there one would wait for it
    int few_open = 4;               ///< directions: a rough mesh shows some that are none
};
inline constexpr PriorNeedConstants k_needed;

}  // namespace culet
