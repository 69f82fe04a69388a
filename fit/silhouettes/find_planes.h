#pragma once
// All planes that outlines show, the mesh's and further ones. Private to the room.

#include <vector>

#include "fit/silhouettes/plane_fit.h"
#include "stone/stone.h"

namespace culet {

/// Planes of the mesh come first, in its order.
struct FoundPlanes {
    PlaneFit fit;
    std::vector<int> mesh_facet;  ///< of each plane; -1: the outlines added it
    std::vector<int> lost;        ///< facets of the mesh that have no room
};
/// How many are the mesh's.
std::size_t mesh_planes(const FoundPlanes& found);

/// Fits the planes of the mesh, then further ones where the body stands out over the outlines,
/// until no more are missing. `problem` begins with the mesh's facets, and ends with the planes
/// that were found. Throws InputError when they enclose nothing.
FoundPlanes find_planes(const Stone& mesh, PlaneFitProblem& problem);

}  // namespace culet
