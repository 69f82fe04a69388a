#pragma once
// A design's tiers as the solid has them, to be compared with another's.

#include <string>
#include <vector>

#include "stone/design/design.h"

namespace culet {

/// What is no difference to a cutter: degrees, and teeth.
inline constexpr double k_equal_deg = 5e-4, k_equal_teeth = 1e-3;

/// A tier as it is cut: mean of its facets where the solid has them.
struct TierAsCut {
    std::string title;
    const DesignTier* own = nullptr;
    char side = 'C';  ///< P, G or C
    double angle_deg = 0, distance = 0;
    double up = 1;              ///< z of its normals
    std::vector<double> turns;  ///< azimuths, of 1, sorted; none of level facets
    std::string teeth;          ///< in words
};

/// `cutting_design` of a solid; `width` and `middle` (height) are the solid's.
struct DesignAsCut {
    explicit DesignAsCut(const Solid& solid);
    DesignAsCut(const DesignAsCut&) = delete;  // tiers point into the design
    DesignAsCut& operator=(const DesignAsCut&) = delete;

    Design design;
    std::vector<TierAsCut> tiers;
    double width = 0, middle = 0;
};

}  // namespace culet
