#pragma once
// Finds facets that the outlines show and the planes lack. Private to the room.

#include <vector>

#include "fit/silhouettes/plane_fit.h"

namespace culet {

/// At most `most` planes that cut off the body where it extends beyond the outlines by more than
/// their scatter: at corners and edges of the projected outline, the deepest first, one for each
/// place. A girdle drawn with few facets gets more.
std::vector<Plane> missing_planes(const PlaneFitProblem& problem, const PlaneFit& fit,
                                  std::size_t most);

}  // namespace culet
