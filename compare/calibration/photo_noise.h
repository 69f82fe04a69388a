#pragma once
// How noisy a photograph is, as the electrons that a camera with that noise would count.

#include "compare/calibration/simulated_camera.h"
#include "compare/scores/aligned_pair.h"
#include "compare/scores/metrics.h"

namespace culet {

/// Electrons at the clipping level (`pictures.white`) of a camera whose shot noise is that of the
/// photo under the mask. In the root of light shot noise is alike everywhere, 1 / (2 sqrt(N))
/// (Anscombe 1948); it is read from what neither planes nor second-order changes explain
/// (`noise_of`): the render as a lens of `psf_px` would show it, with its facets' edges, has as
/// much of that when it is given this noise. The steps of a file of `bits` (0: none) are taken off.
/// Clipped and very dark pixels are left out. From 100 to 1e6; 1e6 for no noise at all.
double photo_electrons(const MatchedPictures& pictures, double psf_px, int bits);

/// Gives the camera the photo's blur (photo_blur.h) and noise; its `bits` must be the file's. In
/// steps of a tenth of a pixel and of 9 % of noise, which is about what can be told: calibrations
/// are kept by their camera.
void set_blur_and_noise(CameraModel& camera, const MatchedPictures& pictures);

/// What the photograph tells of its own camera.
CameraModel camera_of(const Photo& photo, const AlignedPair& pair);

}  // namespace culet
