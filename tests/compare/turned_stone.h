#pragma once
// Pictures of a back-lit stone on a turntable with a known axis and camera.

#include <opencv2/core.hpp>
#include <random>

#include "compare/photo/photo.h"
#include "stone/solid/solid.h"

namespace culet::synthetic {

struct TurntableTruth {
    int size = 1200;                 ///< pixels, each side
    double pixel = 0.007;            ///< side of a pixel, in the solid's unit
    double axis_px = 0;              ///< from the picture's middle
    double roll = 0, elevation = 0;  ///< radians, as in Turntable
    double blur_px = 1;              ///< standard deviation of the point spread
    double noise = 0.01;             ///< of the background, one standard deviation
    bool eight_bit = true;
};

/// The stone stands upright on the axis through the origin, turned counter-clockwise by `turn`.
/// Light falls off towards the corners by a tenth; inside the outline the stone is dark, with a
/// bright spot in its middle.
Photo turned_picture(const Solid& solid, double turn, const TurntableTruth& truth,
                     std::mt19937_64& random);

}  // namespace culet::synthetic
