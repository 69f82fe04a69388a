#pragma once
// Whether a photograph is within the uncertainty of a stone's readings.

#include "compare/scores/compare.h"

namespace culet {

struct AlignedPair;  // compare/scores/aligned_pair.h

/// Nothing where the render has no bands (Photo::bands) or no pixel is compared. The bands are
/// blurred as the photograph is, and widened by its noise and quantisation, but not by registration
/// errors. Clipped pixels are left out.
std::optional<WithinReadings> within_readings(const AlignedPair& pair, const Photo& photo,
                                              const Photo& render);

}  // namespace culet
