#pragma once
// Pictures kept to notice changes, with the variance that chance leaves in them.

#include <filesystem>
#include <string>
#include <vector>

#include "render/image/picture.h"

namespace culet::test {

/// Scenes of samples/effects, without folder and ending.
std::vector<std::string> golden_scenes();

/// The scene, small, drawn by an engine with a seed.
Picture drawn(const std::string& scene, const std::string& engine, std::uint64_t seed);

double mean_radiance(const Picture& picture);

struct GoldenPicture {
    Picture mean;                 ///< of `count` pictures with seeds of their own
    std::vector<float> variance;  ///< of one picture, a sample (3 a pixel)
    int count = 0;
    /// Of `squared_difference` over the pictures it was made of, each held against the others.
    double ratio_mean = 1, ratio_sigma = 0;
};

GoldenPicture golden_of(const std::vector<Picture>& pictures);

/// Squared differences over their variance, both added up over all samples: 1 by chance. What is
/// below a hundredth of the mean radiance counts as chance.
double squared_difference(const Picture& picture, const GoldenPicture& golden);

std::filesystem::path golden_file(const std::string& scene, const std::string& engine);
void write_golden(const GoldenPicture& golden, const std::filesystem::path& file);
GoldenPicture read_golden(const std::filesystem::path& file);

}  // namespace culet::test
