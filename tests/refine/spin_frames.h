#pragma once
// Frames of a simulated turntable: a stone of flat bright and dark facets on a grainy ground.

#include <vector>

#include "fit/silhouettes/turning_camera.h"
#include "refine/spin/spin.h"
#include "stone/solid/solid.h"

namespace culet::synthetic {

struct SpinTruth {
    int size = 320;    ///< pixels, each side
    int specks = 600;  ///< of dust on the ground
    Solid solid;       ///< in the turntable's frame, in pixels
    TurningSeries series;
};

/// A step cut 190 px long that lies on its pavilion, its facets off the design by 0.3 degrees, on a
/// turntable with uneven steps, 48 degrees below a camera 60 stone lengths away.
SpinTruth lying_step_cut(int frames);

/// Blurred by 0.7 pixels, with noise of 1.5 levels. Named frame-001.png, ...
std::vector<SpinFrame> frames_of(const SpinTruth& truth);

}  // namespace culet::synthetic
