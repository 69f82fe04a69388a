#pragma once
// What a person moves on the cut screen.

#include <string>
#include <vector>

#include "render/optimize/tier_design.h"

namespace culet {

/// The angle of tiers that change together; or the height of the crown or the depth of the
/// pavilion, whose tangents then change by one factor.
struct CutHandle {
    std::string name;
    StonePart part = StonePart::crown;
    std::vector<int> tiers;  ///< of the TierDesign
    bool is_height = false;
    double value = 0;  ///< degrees, or per cent of the width
};

std::vector<CutHandle> handles_of(const TierDesign& design, const Solid& solid);

/// Radians by tier (TierDesign::with), for `share` of the way to `value`.
std::vector<double> turned_to(const TierDesign& design, const Solid& solid, const CutHandle& handle,
                              double value, double share);

}  // namespace culet
