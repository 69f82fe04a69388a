#pragma once
// Whether a photograph is within what the readings of a stone leave open.

#include <optional>

#include "compare/scores/aligned_pair.h"
#include "compare/scores/compare.h"

namespace culet {

/// `render` has bands (Photo::bands); nothing without, or where no pixel can be compared. Pixels
/// that the camera clipped are left out. The photograph's own noise and blur are not in the bands.
std::optional<WithinReadings> within_readings(const AlignedPair& pair, const Photo& render);

}  // namespace culet
