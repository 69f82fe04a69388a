#pragma once
// Whether a photograph is within what the readings of a stone leave open.

#include "compare/scores/compare.h"

namespace culet {

struct AlignedPair;  // compare/scores/aligned_pair.h

/// Of a pair that was laid on each other; nothing where the render has no bands (Photo::bands), or
/// nothing is to be compared. The bands are blurred as the photograph is, and widened by its noise
/// and by the steps of its file; pixels that the camera clipped are left out. What the registration
/// is off by is not in them.
std::optional<WithinReadings> within_readings(const AlignedPair& pair, const Photo& photo,
                                              const Photo& render);

}  // namespace culet
