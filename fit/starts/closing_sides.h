#pragma once
// Decides which way facets look from the edges read round them. Private to the room.

#include <vector>

#include "fit/model/fit_model.h"

namespace culet {

/// A facet's inclination and azimuth leave two normals: it may look up or down. The directions of
/// its edges follow from its normal and its neighbours', and the edges, with the lengths read, have
/// to close round the facet. Along a girdle neighbours differ by a few degrees: their common edge
/// runs across the girdle if both have the right side, and aslant if only one does. So this tells
/// the sides apart even where the mesh's corners are off by as much as the facet is high.
///
/// `known`: 1 for each facet that the mesh shows to look up, -1 down, 0 unknown; known ones do not
/// change. Returns it with more sides known: of facets whose azimuth and inclination were read,
/// where the other side would be worse by at least five sigmas. What was not read is taken from the
/// mesh, whose corners have the error `rough`.
///
/// Minimises the sum of the facets' misfits by chains of turns (Kernighan & Lin 1970), starting
/// from the mesh's sides. A facet's misfit depends on a few sides, and is capped since a reading
/// may be wrong.
std::vector<int> closing_sides(const FitModel& model, std::vector<int> known, double rough);

}  // namespace culet
