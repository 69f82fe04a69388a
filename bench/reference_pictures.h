#pragma once
// Pictures of the reference, each drawn once, and the difference of others from them.

#include <filesystem>
#include <map>
#include <string>

#include "render/image/picture.h"
#include "render/scene/scene.h"

namespace culet {

struct Difference {
    double rmse = 0;  ///< over all pixels and colours of the picture, linear radiance
    double peak = 0;  ///< largest radiance of the second picture
    double mean = 0;  ///< of the second picture
    int off = 0;      ///< pixels that differ by more than 1e-3 of the peak
    /// Mean luminance difference over the first picture's pixels of the stone.
    double of_stone = 0;
    double psnr() const;
};
Difference difference(const Picture& picture, const Picture& reference);

class ReferencePictures {
public:
    /// `cache`: keeps pictures between runs; may be empty. Pictures are identified by scene only:
    /// empty it when the reference renderer changes.
    explicit ReferencePictures(std::filesystem::path cache) : cache_(std::move(cache)) {}

    const Picture& at(const Scene& scene, int samples);

private:
    std::filesystem::path cache_;
    std::map<std::string, Picture> drawn_;  // keyed by what the picture depends on
};

}  // namespace culet
