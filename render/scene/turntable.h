#pragma once
// A stone on a turntable, before a camera and lights that stand still.

#include "render/scene/scene.h"

namespace culet {

/// The stone turned by `angle` (radians, counter-clockwise seen from above) about its own axis: its
/// `up`, through the middle of its volume.
Scene turned(const Scene& scene, double angle);

}  // namespace culet
