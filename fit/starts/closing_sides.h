#pragma once
// Which way facets look, told by the edges read round them. Private to the room.

#include <vector>

#include "fit/model/fit_model.h"

namespace culet {

/// An inclination does not say whether a facet looks up or down; with its azimuth it leaves two
/// normals. The directions of a facet's edges follow from its normal and those of its neighbours,
/// and the edges, as long as they were read, have to close round the facet. Along a girdle
/// neighbours differ by a few degrees, and an edge between two of them lies across the girdle
/// where both lean as they do, and aslant where only one does: so the two normals of a facet are
/// told apart even where its corners in the mesh are off by as much as it is high.
///
/// `known`: of each facet 1 where the mesh says that it looks up, -1 down, 0 where it does not say;
/// none of the former changes. Returns the same, with the sides of more facets known: of those
/// whose azimuth and inclination were read, where the other side would be worse by five sigmas at
/// least. What was not read is taken from the mesh, as surely as it is drawn: `rough` is by how
/// much its corners are off.
///
/// Every facet has a misfit of its own in the sides of a few, capped since a reading may be wrong;
/// the least sum is looked for by chains of turns (Kernighan & Lin 1970) from where the mesh has
/// them.
std::vector<int> closing_sides(const FitModel& model, std::vector<int> known, double rough);

}  // namespace culet
