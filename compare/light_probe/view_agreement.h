#pragma once
// Agreement of two aligned views of a ball.

#include <opencv2/core/mat.hpp>

#include "compare/light_probe/view_solver.h"

namespace culet {

/// Luminance below which stops are meaningless: 1 / 500 of the picture's mean.
double floor_of(const Photo& picture);

/// Log2 of luminance over the floor, CV_32F; blurs linear light, not stops.
cv::Mat stops_of(const Photo& picture, double sigma_px);
/// Bilinear.
double stops_at(const cv::Mat& stops, const PixelPlace& place);

/// Of stops, where both views show well.
double correlation_of(const ViewPair& pair, const ViewParameters& p);

/// Gain, first over second: the median over blocks of directions of the ratios of their summed
/// linear light, which blur hardly changes (it shifts medians of stops).
double gain_of(const ViewPair& pair, const ViewParameters& p);

}  // namespace culet
