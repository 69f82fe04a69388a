#pragma once
// Whether a circle in a photograph is a mirror ball.

#include <opencv2/core.hpp>

#include "compare/light_probe/mirror_ball.h"

namespace culet {

/// How many times more the light changes along the radius than across it, in a ring inside the
/// circle's rim. A mirror ball presses the room together towards its rim: at the share rho of its
/// radius 1 / (1 - rho^2) times, from the angles of reflection; 7 to 50 times in this ring, less
/// where the picture is soft. Elsewhere it is about 1. `light`: CV_32F, one channel, 0 to 1; 0
/// where the ring is not in the picture.
double rim_compression(const cv::Mat& light, const BallCircle& circle);

}  // namespace culet
