#pragma once
// Plane observations from outlines or a photograph, in the frame of the fit.

#include <memory>
#include <vector>

#include "fit/model/frame.h"
#include "fit/planes/plane_observations.h"

namespace culet {

/// Rows refer to the azimuth at which the stone was seen; the shape is turned back to it.
struct KnownPlanes : PlaneObservations {
    bool turns = true;  ///< the stone's azimuth when it was seen is unknown
};

/// Lists one for all outlines together, and one for each photograph.
std::vector<std::shared_ptr<const KnownPlanes>> list_known_planes(
    const Frame& frame, const std::vector<Reading>& readings, bool turns);

}  // namespace culet
