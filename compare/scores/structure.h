#pragma once
// Two structural scores from the literature. Both tolerate monotone changes of brightness or any
// change of light, so neither tells a right light from a wrong one.

#include <opencv2/core/mat.hpp>
#include <optional>

#include "compare/scores/metrics.h"

namespace culet {

/// Gradient magnitude similarity deviation (Xue, Zhang, Mou, Bovik 2014) of encoded luminance on
/// the scale 0..255, at half size as in the paper; 0 for equal pictures. The deviation of the map
/// of OpenCV's `quality` under the mask without its border pixels. Nothing when no pixel is left.
std::optional<double> gmsd(const ShownPictures& pictures, const cv::Mat& mask);

/// Normalised mutual information (Studholme, Hill, Hawkes 1999): (H(A) + H(B)) / H(A, B) of encoded
/// luminance in 64 equal steps of each range. 1: independent; 2: each determines the other, by any
/// tone curve. Nothing when both are flat.
std::optional<double> normalized_information(const ShownPictures& pictures, const cv::Mat& mask);

}  // namespace culet
