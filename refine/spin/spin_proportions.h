#pragma once
// The proportions of a stone from a spin series, as laboratories print them.

#include <string>
#include <vector>

#include "refine/spin/standing_stone.h"

namespace culet {

struct SpinProportion {
    std::string name;
    double value = 0;
    double sigma = 0;
    bool read = false;  ///< facets that outlines or edges show bound it
};

/// `width`, in the solid's unit, and `length_to_width` as calipers find them
/// (stone/solid/caliper.h); `table_pct` between the two opposite sides of the table nearest to x;
/// `depth_pct`, and its parts `crown_height_pct`, `girdle_pct` and `pavilion_depth_pct`, which
/// count from the mean heights of the girdle's corners; `crown_angle_deg` and
/// `pavilion_angle_deg`, means over at least three mains
/// (stone/design/tiers.h) within 6 degrees. Per cents are of the width.
/// What the stone does not have is left out. `length_sigma`: of a length across the stone.
std::vector<SpinProportion> proportions_of(const StandingStone& stone, double length_sigma);

/// Null: the stone does not have it.
const SpinProportion* proportion(const std::vector<SpinProportion>& all, const std::string& name);

}  // namespace culet
