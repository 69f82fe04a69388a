#pragma once
// Stored pictures for noticing changes, with their sampling variance.

#include <filesystem>
#include <string>
#include <vector>

#include "render/image/picture.h"

namespace culet::test {

/// Scenes of samples/effects, without folder and extension.
std::vector<std::string> golden_scenes();

/// The scene in small size, drawn by an engine with a seed.
Picture drawn(const std::string& scene, const std::string& engine, std::uint64_t seed);

double mean_radiance(const Picture& picture);

struct GoldenPicture {
    Picture mean;                 ///< of `count` pictures with different seeds
    std::vector<float> variance;  ///< of one picture, per sample (3 per pixel)
    int count = 0;
    /// Of `squared_difference` over the stored pictures, each compared with the others.
    double ratio_mean = 1, ratio_sigma = 0;
};

GoldenPicture golden_of(const std::vector<Picture>& pictures);

/// Sum of squared differences over sum of variances, over all samples: 1 by chance. What is below a
/// hundredth of the mean radiance counts as chance.
double squared_difference(const Picture& picture, const GoldenPicture& golden);

std::filesystem::path golden_file(const std::string& scene, const std::string& engine);
void write_golden(const GoldenPicture& golden, const std::filesystem::path& file);
GoldenPicture read_golden(const std::filesystem::path& file);

}  // namespace culet::test
