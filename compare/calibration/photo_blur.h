#pragma once
// Estimates how much blurrier a photograph is than its render.

#include "compare/photo/photo.h"
#include "compare/scores/metrics.h"

namespace culet {

/// Standard deviation in pixels of the Gaussian that gives the render as much fine detail (between
/// one and two pixels) as the photo has under the mask. Amounts are compared, not places, because
/// small facet errors move edges but keep their number. From 0 to 4; 0 where the photo has more
/// detail. Accurate to about 0.3 pixels from 100 pixels of stone on.
double photo_blur_px(const MatchedPictures& pictures);

/// Root of the light, clipped at `white`: there the noise is uniform.
cv::Mat root_of(const cv::Mat& light, double white);

/// Blurs by a Gaussian point spread of this standard deviation. A photo's coverage stays.
cv::Mat softened(const cv::Mat& picture, double psf_px);
Photo softened(const Photo& picture, double psf_px);

}  // namespace culet
