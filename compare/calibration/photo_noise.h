#pragma once
// A photograph's noise, as the electrons that a camera with that noise counts.

#include "compare/calibration/simulated_camera.h"
#include "compare/scores/aligned_pair.h"
#include "compare/scores/metrics.h"

namespace culet {

/// Electrons at the clipping level (`pictures.white`) that explain the photo's shot noise under the
/// mask, which in the root of light is uniform, 1 / (2 sqrt(N)) (Anscombe 1948). Finds the noise
/// that the render, blurred by `psf_px`, needs for the photo's value of `noise_of`; so facet edges
/// do not count as noise. Subtracts the quantisation of a file of `bits` (0: none). Omits clipped
/// and very dark pixels. From 100 to 1e6, which means no noise.
double photo_electrons(const MatchedPictures& pictures, double psf_px, int bits);

/// Gives the camera the photo's blur (photo_blur.h) and noise; its `bits` must be the file's.
/// Rounds to 0.1 pixels and 9 % of noise, about their accuracy, because calibrations are cached by
/// camera.
void set_blur_and_noise(CameraModel& camera, const MatchedPictures& pictures);

CameraModel camera_of(const Photo& photo, const AlignedPair& pair);

}  // namespace culet
