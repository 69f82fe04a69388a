#pragma once
// Where a fit to outlines begins. Private to the room.

#include <memory>
#include <vector>

#include "fit/silhouettes/plane_fit.h"
#include "fit/silhouettes/registration.h"
#include "stone/stone.h"

namespace culet {

/// Planes in the frame in which they are fitted, and the sets' motions to it: the mesh's frame
/// where one set was taken in it, else that of the first set.
struct SilhouetteStart {
    PlaneFitProblem problem;
    Similarity from_mesh;
    bool in_mesh_frame = false;
};

/// The mesh scaled to the outlines, and turned and shifted to them where their frame is free.
SilhouetteStart silhouette_start(const Stone& mesh,
                                 const std::vector<std::shared_ptr<const SilhouetteSet>>& sets);

/// In their order; `set` is the number of the set that they are of.
std::vector<FlatContour> flattened(const std::vector<Contour>& contours, int set);

}  // namespace culet
