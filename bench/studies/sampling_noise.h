#pragma once
// The noise of pictures from random rays.

#include <filesystem>
#include <string>
#include <vector>

#include "render/image/picture.h"

namespace culet {

struct SamplingNoise {
    int samples = 0;     ///< rays a pixel
    double rms = 0;      ///< standard deviation of a pixel's colour, over all pixels and colours
    double seconds = 0;  ///< processor time of one picture
    Picture picture;
};

/// Draws a scene file with the reference renderer, `width` pixels wide: two pictures with different
/// random numbers per number of samples, whose difference has twice the variance of either.
/// `overrides` are keys of the scene.
std::vector<SamplingNoise> sampling_noise(const std::filesystem::path& scene, int width,
                                          const std::vector<int>& samples,
                                          const std::vector<std::string>& overrides = {});

}  // namespace culet
