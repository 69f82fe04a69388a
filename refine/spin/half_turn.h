#pragma once
// Completes a stone by its symmetry where no frame shows it: what lies on the turntable.

#include <optional>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

struct HalfTurned {
    Solid solid;
    std::vector<double> tilt_sigmas;  ///< by facet
    std::vector<int> copies;          ///< facets half a turn from one that is shown
    int pairs = 0;                    ///< of shown facets that are half a turn from each other
    double axis_sigma = 0;            ///< of a pair's offset from the axis, a length
};

/// `solid`: upright, with z along its axis of symmetry, which goes through the place that most
/// pairs of `shown` facets agree on. Facets that are not shown are replaced by copies of those that
/// are, half a turn about this axis. Nothing if fewer than `k_least_pairs` agree, or if the copies
/// enclose no stone.
std::optional<HalfTurned> completed_by_half_turn(const Solid& solid,
                                                 const std::vector<double>& tilt_sigmas,
                                                 const std::vector<bool>& shown);

inline constexpr int k_least_pairs = 6;

}  // namespace culet
