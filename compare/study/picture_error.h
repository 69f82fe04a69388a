#pragma once
// The error of a render against a finer one of the same view, by pixels, without registration or
// gain.

#include <opencv2/core/mat.hpp>
#include <optional>

#include "compare/scores/metrics.h"
#include "compare/study/scene_study_result.h"
#include "render/image/picture.h"

namespace culet {

class PictureMetric {
public:
    /// The stone's pixels are those with coverage in the reference; without coverage, all. White,
    /// for encoded pictures, is five times their mean.
    explicit PictureMetric(Picture truth);

    PictureError error_of(const Picture& picture) const;
    /// Luminance of `picture` minus the reference's, relative to the mean; NaN beside the stone.
    PixelMap difference(const Picture& picture) const;

    const Picture& truth() const { return truth_; }
    int stone_pixels() const { return stone_pixels_; }
    double mean_radiance() const { return mean_; }  ///< of R, G and B over the stone's pixels
    double white() const { return matched_.white; }

private:
    Picture truth_;
    MatchedPictures matched_;  // `photo` is the reference
    double mean_ = 0;
    int stone_pixels_ = 0;
};

}  // namespace culet
