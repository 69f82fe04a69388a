#pragma once
// What differs between two designs, as a cutter would say it.

#include <string>
#include <vector>

#include "stone/design/design.h"

namespace culet {

struct DesignDifference {
    std::string what;  ///< gear, symmetry, ..., tier, name, angle, index settings, depth, ...
    std::string tier;  ///< its name in the first design, or else in the second; empty: of the whole
    std::string a, b;  ///< in words; "none": the design lacks it
};

/// Compares gear, symmetry, refractive index, material, order of cutting, notes, and tier by tier
/// name, angle, index settings, depth, instruction and surface. Tiers are matched by name and
/// setting, so one of another name is renamed. Size and height above the origin are no difference:
/// depths are compared after the scale and shift on which most tiers agree. Angles count from
/// 0.0005 degrees, index settings from 0.001 teeth, depths from 2e-5 of the width. A mesh has the
/// design that it shows (`cutting_design`).
std::vector<DesignDifference> design_differences(const Solid& a, const Solid& b);

/// "P1: angle: 41, then 42"
std::string words_of(const DesignDifference& difference);

}  // namespace culet
