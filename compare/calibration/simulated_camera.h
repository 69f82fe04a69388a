#pragma once
// What a camera makes of a picture: the render as it would look, had it been photographed.

#include <array>
#include <cstdint>

#include "compare/photo/photo.h"

namespace culet {

/// Of the photograph that is being judged, at the size at which it is compared.
struct CameraModel {
    double psf_px = 0.7;                   ///< standard deviation of the point spread
    double electrons = 10000;              ///< at the clipping level: shot noise is their root
    double read_noise = 6;                 ///< electrons
    int bits = 8;                          ///< of the sRGB-encoded file; 0: linear floats
    bool clips = true;                     ///< at 1
    std::array<double, 3> gain{1, 1, 1};   ///< exposure and white balance: 1 is the clipping level
    std::array<float, 3> ground{0, 0, 0};  ///< what surrounds the stone, after the gain
    /// The stone's outline is found in the picture, as it was in the photograph; false: the
    /// coverage is kept, as a mask or an alpha channel would tell it.
    bool outline_from_background = true;
    /// The picture is moved by up to half a pixel either way and scaled by up to so much: the
    /// registration must undo it, resampling as it does for the photograph.
    double scale_error = 0.002;
};

/// `stone` must have coverage.
Photo photographed(const Photo& stone, const CameraModel& camera, std::uint64_t seed);

/// The factor on the gain that brings the 99th percentile of the stone to where `model`'s is.
double exposure_like(const Photo& stone, const Photo& model);

}  // namespace culet
