#pragma once
// Pictures as OpenCV matrices. Private to the folder. Colour is CV_32FC3 in the order R, G, B,
// linear light; masks are CV_8U, 0 or 255. Positions are in pixels with the centre of the first
// pixel at (0, 0), x to the right, y down.

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>

#include "compare/photo/photo.h"

namespace culet {

/// A view of the photo's pixels, not a copy.
cv::Mat colour_of(const Photo& photo);

/// Luminance of linear sRGB primaries (Rec. ITU-R BT.709-6, item 3.2), CV_32F.
cv::Mat luminance(const cv::Mat& colour);

/// Each sample through the sRGB transfer function after clipping to 0..1.
cv::Mat encoded(const cv::Mat& linear);

/// PNG file bytes; CV_8U with 1 channel, or 3 in the order R, G, B.
std::string png_bytes(const cv::Mat& pixels);

/// Bilinear, of CV_32F (x to the right, y down); the border's value beyond it. `slope`: the
/// surface's gradient.
double between_pixels(const cv::Mat& plane, double x, double y, cv::Point2d* slope = nullptr);

cv::Mat brightest_channel(const cv::Mat& colour);

/// The `share` quantile (0..1) under the mask, 0 if that is empty; without a mask of all pixels.
double quantile(const cv::Mat& plane, const cv::Mat& mask, double share);

}  // namespace culet
