#pragma once
// Constants of the hypotheses: unit, meaning, and the bench they come from. Lengths are in half
// diameters, gains in chi-square. A constant without a bench lies far between the two sizes that it
// separates. Private to the room.

#include <cstddef>

namespace culet {

/// What a hypothesis must gain, and what it may cost.
struct TrialConstants {
    /// Starts of a fit under a hypothesis; one where the first fit took more than `dear_work`
    /// multiplications.
    int few_starts = 2;
    double dear_work = 2e9;
    /// Sigma that takes a reading out of the fit, relative to its value.
    double next_to_nothing = 1e3;
    /// A reading explains why there is no stone if the fit without it leaves less than this part of
    /// chi-square.
    double chi2_left_without = 0.01;
    /// Chi-square that the mirror image of the mesh must gain: five sigmas.
    double least_gain_of_mirror = 25;
    /// Azimuths that count from another mark are off by a multiple of `mark_deg`, within
    /// `near_deg`: errors of the mesh turn it by less.
    double mark_deg = 15, near_deg = 4;
    /// Turned azimuths explain a contradiction if they leave less than this part of chi-square.
    double chi2_left_turned = 0.5;
    /// Sigma of an unread size, relative to it. It is not exact: angles that fit no stone would
    /// then contradict the size.
    double as_good_as_exact = 1e-6;
};
inline constexpr TrialConstants k_trials;

/// Changes of the topology (topology.h).
struct TopologyConstants {
    /// Edges shorter than this part of the diameter may change; at most so many are tried.
    double doubtful = 0.1;
    std::size_t most_doubtful = 6;
};
inline constexpr TopologyConstants k_topology;

}  // namespace culet
