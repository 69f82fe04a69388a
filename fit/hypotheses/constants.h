#pragma once
// The numbers of the hypotheses: unit, meaning, and where each comes from. Lengths are in half
// diameters, gains in chi-square; numbers without a bench lie far between the two sizes that they
// tell apart. Private to the room.

#include <cstddef>

namespace culet {

/// What a hypothesis must gain, and what it may cost.
struct TrialConstants {
    /// Starts where what is wrong was found; one where those before took more multiplications.
    int few_starts = 2;
    double dear_work = 2e9;
    /// Of the value itself: what is so uncertain pulls at nothing.
    double next_to_nothing = 1e3;
    /// What explains why there is no stone takes nearly all of chi-square with it.
    double chi2_left_without = 0.01;
    /// What it costs in chi-square to take the mesh for its mirror image: five sigmas.
    double price_of_mirror = 25;
    /// Who reads from the wrong mark is off by a mark; what the mesh's own errors turn it by is
    /// less.
    double mark_deg = 15, near_deg = 4;
    /// What explains a contradiction takes most of chi-square with it.
    double chi2_left_turned = 0.5;
    /// Of the size. Not exact: where the angles are no stone's, nothing can be, and the size is not
    /// what they contradict.
    double as_good_as_exact = 1e-6;
};
inline constexpr TrialConstants k_trials;

/// Changes of the topology (topology.h).
struct TopologyConstants {
    /// Of the diameter; and how many are tried.
    double doubtful = 0.1;
    std::size_t most_doubtful = 6;
};
inline constexpr TopologyConstants k_topology;

}  // namespace culet
