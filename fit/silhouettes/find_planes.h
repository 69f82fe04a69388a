#pragma once
// Finds all planes that outlines show, the mesh's and further ones. Private to the room.

#include <optional>
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

/// How far outlines that show a plane edge-on reach along its normal: the median, against dust and
/// cut-off outlines. No value: none shows it.
std::optional<double> reach_along(const Vec3& normal, const PlaneFitProblem& problem,
                                  const Viewpoints& from);

/// Fits the mesh's planes, then adds planes where the body extends beyond the outlines. `problem`
/// starts with the mesh's facets, or with planes of no mesh after them, and returns with the planes
/// found. Throws InputError if they
/// enclose nothing.
FoundPlanes find_planes(const Stone& mesh, PlaneFitProblem& problem);

}  // namespace culet
