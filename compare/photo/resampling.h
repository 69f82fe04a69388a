#pragma once
// Resamples a picture onto another's pixels. OpenCV's warpAffine would round positions to 1/32
// pixel.

#include <opencv2/core/mat.hpp>

namespace culet {

enum class Kernel {
    linear,
    cubic  ///< Catmull and Rom (1974): interpolating, keeps single reflexes sharp
};
enum class Beyond {
    nearest,  ///< the nearest border pixel
    nothing   ///< zero
};

/// `source` (CV_32F, 1 or 3 channels) at the pixels of `target_size`, mapped by
/// `source_from_target`. Negative overshoots of the cubic beside bright spots are set to 0.
cv::Mat resampled(const cv::Mat& source, const cv::Matx23d& source_from_target,
                  cv::Size target_size, Kernel kernel, Beyond beyond);

/// The same for a mask (CV_8U, 0 or 255): linear, thresholded at one half, zero beyond its border.
cv::Mat resampled_mask(const cv::Mat& mask, const cv::Matx23d& source_from_target,
                       cv::Size target_size);

}  // namespace culet
