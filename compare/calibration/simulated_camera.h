#pragma once
// Simulates a camera: the render as it would look if it had been photographed.

#include <array>
#include <cstdint>

#include "compare/photo/photo.h"

namespace culet {

/// The photograph's camera, at the size of the comparison.
struct CameraModel {
    double psf_px = 0.7;                   ///< standard deviation of the point spread
    double electrons = 10000;              ///< at the clipping level; shot noise is their root
    double read_noise = 6;                 ///< electrons
    int bits = 8;                          ///< of the sRGB-encoded file; 0: linear floats
    bool clips = true;                     ///< at 1
    std::array<double, 3> gain{1, 1, 1};   ///< exposure and white balance: 1 is the clipping level
    std::array<float, 3> ground{0, 0, 0};  ///< colour around the stone, after the gain
    /// True: find the outline against the background, as in the photograph. False: keep the
    /// coverage, as with a mask or an alpha channel.
    bool outline_from_background = true;
    /// The picture is moved by up to half a pixel and scaled by up to this share at random, so that
    /// registration must resample it like the photograph.
    double scale_error = 0.002;
};

/// `stone` must have coverage.
Photo photographed(const Photo& stone, const CameraModel& camera, std::uint64_t seed);

/// Gain factor from the stone's 99th percentile to that of `model`.
double exposure_like(const Photo& stone, const Photo& model);

}  // namespace culet
