#pragma once
// What outlines or a photograph tell of the planes, in the scale and place of the fit.

#include "fit/planes/plane_knowledge.h"

namespace culet {

/// Normals are turned back about up, to stand as the stone did when it was seen.
struct KnownPlanes : PlaneKnowledge {
    bool turns = true;  ///< it is not known how the stone stands about up
};

}  // namespace culet
