#pragma once
// Frames of a simulated turntable: a stone on a grainy ground.

#include <string>
#include <vector>

#include "fit/silhouettes/turning_camera.h"
#include "refine/spin/spin.h"
#include "stone/solid/solid.h"

namespace culet::synthetic {

struct SpinTruth {
    int size = 320;    ///< pixels, each side
    int specks = 600;  ///< of dust on the ground
    /// False: flat bright and dark facets. True: a diamond under a white dome, rendered, with a
    /// soft shadow, by a camera that sharpens and writes JPEG.
    bool lit = false;
    Solid solid;  ///< in the turntable's frame, in pixels
    TurningSeries series;
};

/// A step cut 190 px long that lies on its pavilion, its facets off the design by 0.3 degrees, on a
/// turntable with uneven steps, 48 degrees below a camera 60 stone lengths away.
SpinTruth lying_step_cut(int frames);

/// An upright stone, laid on the pavilion facet on which it stands best, `length` pixels across its
/// corners. The turntable wobbles by 0.2 degrees (root mean square), the first frame is off by 1.3.
SpinTruth lying(const Solid& upright, double length, double elevation, int frames, unsigned seed);

/// Blurred by 0.7 pixels, with noise of 1.5 levels. Named frame-001.png, ...
std::vector<SpinFrame> frames_of(const SpinTruth& truth);

}  // namespace culet::synthetic
