#pragma once
// What differs from a photograph's plain background.

#include <opencv2/core/mat.hpp>

namespace culet {

struct Differing {
    cv::Mat mask;
    cv::Mat difference;   ///< CV_32F, largest over the channels, possibly blurred
    double blur = 0;      ///< sigma, pixels
    float threshold = 0;  ///< of the difference
};

/// `shown`: CV_32FC3, encoded. A noisy picture is first blurred until its noise is below the
/// relevant differences.
Differing differing(const cv::Mat& shown);

}  // namespace culet
