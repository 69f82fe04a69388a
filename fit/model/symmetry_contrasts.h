#pragma once
// Approximate symmetry, "8-fold within 0.3 degrees": what it says of the directions of the facets
// of one orbit. Private to the room.
//
// Each facet stands off the direction that perfect symmetry would give it by an error of its own.
// That direction is not known but by the facets themselves, so that differences of facets, or
// residuals from their mean, hang together. Orthonormal contrasts of n facets do not: n - 1
// combinations with weights that sum to zero and squares that sum to one, each with the sigma of
// one facet (Helmert 1876).

#include <vector>

#include "fit/model/residuals.h"

namespace culet {

/// Two formulas a contrast, each 0 in perfect symmetry. `orbit` are facets each the image of the
/// one before under a turn by `angle` about up; `mesh` tells where they look.
std::vector<Formula> turn_contrasts(const Shape& mesh, const std::vector<int>& orbit, double angle);

/// The chains that pairs (facet, image) make up, longer than one.
std::vector<std::vector<int>> orbits_of_pairs(const std::vector<std::pair<int, int>>& pairs);

}  // namespace culet
