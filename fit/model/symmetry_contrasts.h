#pragma once
// Approximate symmetry ("8-fold within 0.3 degrees") as equations for the directions of the facets
// of one orbit. Private to the room.
//
// Each facet deviates from the direction of perfect symmetry by an independent error. That
// direction is known only from the facets themselves, so differences of facets, or residuals from
// their mean, are correlated. Orthonormal contrasts of n facets are not: n - 1 combinations whose
// weights sum to zero and whose squared weights sum to one, each with the sigma of one facet
// (Helmert 1876).

#include <vector>

#include "fit/model/residuals.h"

namespace culet {

/// Two formulas a contrast, each 0 in perfect symmetry. In `orbit` each facet is the image of the
/// previous one under a turn by `angle` about up; `mesh` gives their directions.
std::vector<Formula> turn_contrasts(const Shape& mesh, const std::vector<int>& orbit, double angle);

/// The chains longer than one that pairs (facet, image) form.
std::vector<std::vector<int>> orbits_of_pairs(const std::vector<std::pair<int, int>>& pairs);

}  // namespace culet
