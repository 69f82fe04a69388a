#pragma once
// Finds all planes that outlines show: those of the mesh and further ones. Private to the room.

#include <vector>

#include "fit/silhouettes/plane_fit.h"
#include "stone/stone.h"

namespace culet {

/// The planes of the mesh come first, in its order.
struct FoundPlanes {
    PlaneFit fit;
    std::vector<int> mesh_facet;  ///< by plane; -1: the outlines added it
    std::vector<int> lost;        ///< facets of the mesh that the planes leave no room for
};
/// Number of planes that come from the mesh.
std::size_t mesh_planes(const FoundPlanes& found);

/// Fits the planes of the mesh, then adds planes where the body extends beyond the outlines, until
/// none are missing. `problem` starts with the mesh's facets and returns with the planes found.
/// Throws InputError if they enclose nothing.
FoundPlanes find_planes(const Stone& mesh, PlaneFitProblem& problem);

}  // namespace culet
