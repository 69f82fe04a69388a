#pragma once
// Approximate symmetry, "8-fold within 0.3 degrees": what it says of the facets of one orbit.
// Private to the room.
//
// Each facet stands off the place that perfect symmetry would give it by an error of its own. That
// place is not known but by the facets themselves, so that differences of facets, or residuals
// from their mean, hang together. Orthonormal contrasts of n facets do not: n - 1 combinations
// with weights that sum to zero and squares that sum to one, each with the sigma of one facet
// (Helmert 1876).

#include <vector>

#include "fit/residuals.h"

namespace culet {

/// Three formulas a contrast (two directions of the normals, then offsets), each 0 in perfect
/// symmetry. `orbit` are facets each the image of the one before under a turn by `angle` about the
/// axis at extras (centre, centre + 1); `mesh` tells where facets stand.
std::vector<Formula> turn_contrasts(const Shape& mesh, const Outline& outline,
                                    const std::vector<int>& orbit, double angle, int centre);

/// The chains that pairs (facet, image) make up, longer than one.
std::vector<std::vector<int>> orbits_of_pairs(const std::vector<std::pair<int, int>>& pairs);

}  // namespace culet
