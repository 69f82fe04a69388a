#pragma once
// A circle fitted to the edges of a picture. Inside this room only.

#include <opencv2/core/mat.hpp>
#include <optional>

#include "compare/light_probe/ball_finder.h"

namespace culet {

/// The circle to the edges that rays from its middle meet within `reach` of its radius (RANSAC over
/// three points, then iterated least squares with Tukey's weights): wide, then narrower about what
/// was found. With its support and sigma. `plane`: CV_32F, one channel, 0 to 1. Deterministic.
std::optional<FoundBall> fitted_in_steps(const cv::Mat& plane, const BallCircle& rough,
                                         double reach);

/// The same circle to where light crosses the middle between inside and outside. `linear`: CV_32F,
/// linear light, for the pixels of an edge are means of it. As it was where too few rays have a
/// clear step.
FoundBall to_a_fraction_of_a_pixel(const cv::Mat& linear, FoundBall ball);

}  // namespace culet
