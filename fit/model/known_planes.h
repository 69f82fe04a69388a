#pragma once
// What outlines or a photograph tell of the planes, in the frame of the fit.

#include <memory>
#include <vector>

#include "fit/model/frame.h"
#include "fit/planes/plane_observations.h"

namespace culet {

/// Normals are turned back about up, to stand as the stone did when it was seen.
struct KnownPlanes : PlaneObservations {
    bool turns = true;  ///< it is not known how the stone stands about up
};

/// Of all outlines together, and of each photograph.
std::vector<std::shared_ptr<const KnownPlanes>> list_known_planes(
    const Frame& frame, const std::vector<Reading>& readings, bool turns);

}  // namespace culet
