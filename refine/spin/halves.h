#pragma once
// How far two fits to halves of the frames differ.

#include "fit/silhouettes/turning_fit.h"

namespace culet {

/// Facets whose tilt one half does not tell to 2 degrees are left out.
struct Halves {
    int facets = 0;     ///< that were compared
    double tilt = 0;    ///< median angle between the same facets, radians
    double factor = 1;  ///< by which facets differ more than their sigmas say; at least 1
    double up = 0;      ///< between the stone's directions up, radians
    double width = 0;   ///< differences, as parts of the mean
    double length_to_width = 0;
    double elevation = 0;  ///< difference, radians
};
/// By facet: its tilt is better known than a guess.
std::vector<bool> seen_facets(const TurningFit& fit);

Halves compared(const TurningFit& one, const TurningFit& other);

}  // namespace culet
