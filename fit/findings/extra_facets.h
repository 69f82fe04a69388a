#pragma once
// Facets that the mesh lacks: which small plane, cutting off a corner or an edge of the fitted
// stone, would explain residuals that the readings' own errors do not. Private to the room.
//
// A facet that was overlooked (a bruted culet, an extra facet on a corner of the girdle) shortens
// the edges that end where it lies, the widths whose jaws touch there, and the weight, and leaves
// the other facets' angles as they are. For each corner and edge of the mesh, planes of a few
// directions are moved in from where they touch: the readings of the stone cut off by them less
// those of the whole stone are a signature s (in sigmas), and chi-square of the fit with the facet
// is |r + R s|^2 with R = 1 - hat matrix (the linear model about the fit; Koch 1999, 3.4). Its fall
// is a likelihood ratio with one freedom, the depth, on one side: a plane only takes away. The
// level is shared out among all planes tried (Bonferroni).
//
// A wrong reading leaves residuals around itself too. Both kinds of explanation compete, one at a
// time: what lowers chi-square most, its number of alternatives allowed for, is believed and taken
// out, until nothing stands out.

#include <vector>

#include "fit/findings/findings.h"
#include "fit/solve/free_meets.h"
#include "fit/uncertainty/diagnostics.h"

namespace culet {

/// In the scale of the fit, the most telling first; `what` is left empty. None for a stone that is
/// not convex, or without a covariance.
std::vector<ExtraFacet> suspect_extra_facets(const System& system, const Finished& finished,
                                             const Diagnosis& diagnosis, double significance);

}  // namespace culet
