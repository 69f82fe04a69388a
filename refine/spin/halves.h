#pragma once
// How far the stones of two halves of the frames differ.

#include <string>
#include <utility>
#include <vector>

#include "refine/spin/spin_proportions.h"

namespace culet {

/// Facets that outlines or edges tell to 2 degrees in both halves.
struct ComparedFacets {
    int count = 0;
    double tilt = 0;  ///< median angle between the same facets, radians
};

struct Halves {
    /// Of 0.25 mm2 and more, and of 2 mm2 and more, if the stone is 7 mm wide.
    ComparedFacets facets, large_facets;
    double factor = 1;     ///< by which facets differ more than their sigmas say; at least 1
    double up = 0;         ///< between the stones' directions up, radians
    double elevation = 0;  ///< difference, radians
    /// Differences of proportions by name, in their units.
    std::vector<std::pair<std::string, double>> proportions;
};

/// Of the fits to outlines alone.
double factor_of_halves(const TurningFit& one, const TurningFit& other);

/// `factor` is left as it is.
void compare_stones(const StandingStone& one, const StandingStone& other, Halves& halves);

}  // namespace culet
