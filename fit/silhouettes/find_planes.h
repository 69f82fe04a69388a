#pragma once
// Finds all planes that outlines show, the mesh's and further ones. Private to the room.

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
std::size_t mesh_planes(const FoundPlanes& found);

/// Fits the mesh's planes, then adds planes where the body extends beyond the outlines. `problem`
/// starts with the mesh's facets and returns with the planes found. Throws InputError if they
/// enclose nothing.
FoundPlanes find_planes(const Stone& mesh, PlaneFitProblem& problem);

}  // namespace culet
