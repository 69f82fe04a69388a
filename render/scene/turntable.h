#pragma once
// A stone on a turntable in front of a fixed camera and fixed lights.

#include "render/scene/scene.h"

namespace culet {

/// Rotates stones and objects by `angle` (radians, counter-clockwise seen from above) about the
/// stone's `up` through its centroid.
Scene turned(const Scene& scene, double angle);

}  // namespace culet
