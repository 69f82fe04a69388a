#pragma once
// Two scores of structure that are known from the literature. Both take any monotone change of
// brightness, or any change of light, lightly: neither tells a right light from a wrong one.

#include <opencv2/core/mat.hpp>
#include <optional>

#include "compare/scores/metrics.h"

namespace culet {

/// Gradient magnitude similarity deviation (Xue, Zhang, Mou, Bovik 2014) of encoded luminance on
/// the scale 0..255, at half size as its authors have it: 0 for equal pictures. OpenCV's `quality`
/// makes the map; the deviation is taken under the mask, less the pixels at its border. Nothing
/// when no pixel is left.
std::optional<double> gmsd(const ShownPictures& pictures, const cv::Mat& mask);

/// Normalised mutual information (Studholme, Hill, Hawkes 1999): (H(A) + H(B)) / H(A, B) of
/// encoded luminance in 64 equal steps of the range that each picture has. 1: the one says nothing
/// about the other; 2: each follows from the other, whatever tone curve lies between. Nothing when
/// both are flat.
std::optional<double> normalized_information(const ShownPictures& pictures, const cv::Mat& mask);

}  // namespace culet
