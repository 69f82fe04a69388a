#pragma once
// One picture on the pixels of another. Not OpenCV's warpAffine: that rounds positions to 1/32 of a
// pixel.

#include <opencv2/core/mat.hpp>

namespace culet {

enum class Kernel {
    linear,
    cubic  ///< Catmull and Rom (1974): goes through the samples, keeps single reflexes sharp
};
enum class Beyond {
    nearest,  ///< the picture's border goes on
    nothing   ///< zero
};

/// `source` (CV_32F, 1 or 3 channels) at the positions of `target_size` pixels carried over by
/// `source_from_target`. Negative results of the cubic beside bright spots are set to 0.
cv::Mat resampled(const cv::Mat& source, const cv::Matx23d& source_from_target,
                  cv::Size target_size, Kernel kernel, Beyond beyond);

/// A mask (CV_8U, 0 or 255) likewise: linear, cut at one half, nothing beyond its border.
cv::Mat resampled_mask(const cv::Mat& mask, const cv::Matx23d& source_from_target,
                       cv::Size target_size);

}  // namespace culet
