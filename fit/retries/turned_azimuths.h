#pragma once
// Azimuths that all count from another direction than the widths do. Private to the room.

#include <functional>
#include <optional>
#include <vector>

#include "fit/findings/result.h"

namespace culet {

/// `turn`: by how much the azimuths read are ahead of the mesh's, in radians. Where azimuths are
/// said to count from the mesh and stand turned by a multiple of 15 degrees, and the readings
/// contradict each other for it: the fit by `fit_again` of the readings with all azimuths turned
/// back, if that takes most of chi-square away. Its azimuths are as they were read; it accuses
/// none of them, but says what all of them share, first. Otherwise nothing.
std::optional<FitResult> fit_turning_azimuths_back(
    const FitResult& result, const std::vector<Reading>& readings, double turn,
    const std::function<FitResult(const std::vector<Reading>&)>& fit_again);

}  // namespace culet
