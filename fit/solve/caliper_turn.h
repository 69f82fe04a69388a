#pragma once
// Orients an earlier result for a fit that continues from it. Private to the room.

#include "fit/solve/relaxation.h"

namespace culet {

/// Returns the shape turned about up by at most 0.3 degrees, to where it fits the calipers best: a
/// result is stored as its mesh lies, not as it lay between the jaws. Returns it unchanged where
/// other readings or the prior define the azimuth.
Shape turned_to_calipers(const Relaxation& relaxation, const Shape& shape);

}  // namespace culet
