#pragma once
// Facets that the outlines show and the planes lack. Private to the room.

#include <vector>

#include "fit/silhouettes/plane_fit.h"

namespace culet {

/// Planes that cut off where the body stands out over the outlines by more than the outlines'
/// scatter explains: at corners and edges of the projected outline, the deepest first, one for each
/// place. A girdle that was drawn with few facets gets more of them. At most `most`.
std::vector<Plane> missing_planes(const PlaneFitProblem& problem, const PlaneFit& fit,
                                  std::size_t most);

}  // namespace culet
