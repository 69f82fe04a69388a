#pragma once
// Whether a circle in a photograph is a mirror ball.

#include <opencv2/core.hpp>

#include "compare/light_probe/mirror_ball.h"

namespace culet {

/// What a ring inside a circle's rim shows.
struct RimLook {
    /// Ratio of the light's change along the radius to that across it. A mirror ball compresses its
    /// picture at the share rho of its radius by 1 / (1 - rho^2): 7 to 50 times in this ring, less
    /// in a soft picture. Elsewhere about 1.
    double compression = 0;
    /// 0..1: how much of the change along the radius is the same all round. A ball shows something
    /// different on each side; a lid, a ring or a plate has one edge everywhere.
    double alike = 0;
};

/// `light`: CV_32F, one channel, 0 to 1. Zeros if the ring is outside the picture.
RimLook rim_look(const cv::Mat& light, const BallCircle& circle);

}  // namespace culet
