#pragma once
// Estimates a photograph's noise, as the electrons that a camera with that noise would count.

#include "compare/calibration/simulated_camera.h"
#include "compare/scores/aligned_pair.h"
#include "compare/scores/metrics.h"

namespace culet {

/// Electrons at the clipping level (`pictures.white`) of a camera with the shot noise that the
/// photo shows under the mask. In the root of light the shot noise is uniform, 1 / (2 sqrt(N))
/// (Anscombe 1948). It is estimated with `noise_of` as the noise that must be added to the render,
/// blurred by `psf_px`, for the same high-frequency residual; so facet edges do not count as noise.
/// The quantisation noise of a file of `bits` (0: none) is subtracted. Clipped and very dark pixels
/// are left out. From 100 to 1e6, which means no noise at all.
double photo_electrons(const MatchedPictures& pictures, double psf_px, int bits);

/// Gives the camera the photo's blur (photo_blur.h) and noise; its `bits` must be the file's.
/// Rounds to 0.1 pixels and to 9 % of noise, about what can be told, because calibrations are
/// cached by their camera.
void set_blur_and_noise(CameraModel& camera, const MatchedPictures& pictures);

/// The camera model estimated from the photograph itself.
CameraModel camera_of(const Photo& photo, const AlignedPair& pair);

}  // namespace culet
