#pragma once
// The start of a fit to outlines. Private to the room.

#include <memory>
#include <vector>

#include "fit/silhouettes/plane_fit.h"
#include "fit/silhouettes/registration.h"
#include "stone/stone.h"

namespace culet {

/// Planes in the frame of their fit, and the sets' motions to it: the mesh's frame if one set was
/// taken in it, else the first set's.
struct SilhouetteStart {
    PlaneFitProblem problem;
    Similarity from_mesh;
    bool in_mesh_frame = false;
};

/// The mesh scaled to the outlines; also turned and shifted if their frame is free.
SilhouetteStart silhouette_start(const Stone& mesh,
                                 const std::vector<std::shared_ptr<const SilhouetteSet>>& sets);

/// In their order; `set` is the number of their set.
std::vector<FlatContour> flattened(const std::vector<Contour>& contours, int set);

}  // namespace culet
