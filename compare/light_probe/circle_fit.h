#pragma once
// Fits a circle to the edges of a picture. Private to the folder.

#include <opencv2/core/mat.hpp>
#include <optional>

#include "compare/light_probe/ball_finder.h"

namespace culet {

/// Fits the circle to the edges on rays from its middle within `reach` of its radius (RANSAC over
/// three points, then iterated least squares with Tukey's weights), and again in narrower ranges.
/// Sets support and sigma. `plane`: CV_32F, one channel, 0 to 1. Deterministic.
std::optional<FoundBall> fitted_in_steps(const cv::Mat& plane, const BallCircle& rough,
                                         double reach);

/// Refits the circle to where light is half way between inside and outside. `linear`: CV_32F,
/// linear light, of which edge pixels are means. Returns the ball unchanged when too few rays have
/// a clear step.
FoundBall to_a_fraction_of_a_pixel(const cv::Mat& linear, FoundBall ball);

}  // namespace culet
