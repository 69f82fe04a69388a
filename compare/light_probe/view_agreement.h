#pragma once
// What two views of a ball that were brought together have in common.

#include <opencv2/core/mat.hpp>

#include "compare/light_probe/view_solver.h"

namespace culet {

/// Luminance below which stops say nothing: 1 / 500 of the picture's mean.
double floor_of(const Photo& picture);

/// Log2 of luminance above the picture's floor, CV_32F; linear light is blurred, not stops.
cv::Mat stops_of(const Photo& picture, double sigma_px);
/// Bilinear.
double stops_at(const cv::Mat& stops, const PixelPlace& place);

/// Correlation of stops, over what both show well.
double correlation_of(const ViewPair& pair, const ViewParameters& p);

/// First over second, from linear light: the median over blocks of directions of the ratio of what
/// they hold. Sums of light do not care about blur, which shifts medians of stops.
double gain_of(const ViewPair& pair, const ViewParameters& p);

}  // namespace culet
