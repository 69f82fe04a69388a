#pragma once
// How blurred a photograph is beside its render.

#include "compare/photo/photo.h"
#include "compare/scores/metrics.h"

namespace culet {

/// Standard deviation, in pixels, of the Gaussian by which the render must be blurred to have as
/// much fine detail (between one and two pixels) as the photo, under the mask. The amount of detail
/// is compared, not its place: facets that are a little off move edges and leave their number. 0 to
/// 4; 0 where the photo has more detail than the render. Good to some 0.3 pixels for a stone of 100
/// pixels and more.
double photo_blur_px(const MatchedPictures& pictures);

/// Of light up to white: noise is alike everywhere there.
cv::Mat root_of(const cv::Mat& light, double white);

/// The picture as a lens would show it whose point spread is a Gaussian of that standard deviation.
/// A photo's coverage stays as it is.
cv::Mat softened(const cv::Mat& picture, double psf_px);
Photo softened(const Photo& picture, double psf_px);

}  // namespace culet
