#pragma once
// Sums up the shots of a series. Private to the folder.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "compare/photo/photo.h"

namespace culet {

/// 1 well below the clipping level, falling smoothly to 0 near it.
inline float unclipped(const Photo& photo, std::size_t pixel) {
    constexpr float k_fade_from = 0.85f, k_fade_to = 0.97f;  // of saturation
    if (!photo.saturated.empty() && photo.saturated[pixel] > 0) return 0;
    if (photo.saturation <= 0) return 1;
    const float* rgb = photo.rgb.data() + 3 * pixel;
    const float level = std::max({rgb[0], rgb[1], rgb[2]}) / static_cast<float>(photo.saturation);
    if (level <= k_fade_from) return 1;
    const float u = std::max((k_fade_to - level) / (k_fade_to - k_fade_from), 0.0f);
    return u * u * (3 - 2 * u);
}

/// Variance of a shot's value: shot noise and read noise of a small camera, and 8-bit rounding.
class ShotNoise {
public:
    /// `saturation` as in Photo.
    ShotNoise(double saturation, bool eight_bits);
    /// Of a value read as about `value`.
    float variance(float value) const {
        const float level = std::max(value / full_, 0.0f);
        float variance =
            (level * k_full_well + k_read_noise * k_read_noise) / (k_full_well * k_full_well);
        if (!rounding_.empty()) {
            const float step = std::min(level, 1.0f) * float(k_steps) + 0.5f;
            variance += rounding_[static_cast<std::size_t>(step)];
        }
        return variance * full_ * full_;
    }

private:
    static constexpr float k_full_well = 20000;  // electrons at saturation, of a small camera
    static constexpr float k_read_noise = 4;     // electrons
    // Finer than an 8-bit file's steps in the dark (1 / (255 * 12.92)).
    static constexpr std::size_t k_steps = 4096;
    float full_ = 1;
    std::vector<float> rounding_;  // at even steps of value / full; empty: no rounding
};

/// Inverse-variance-weighted mean of the shots' values over their exposures.
class ExposureSum {
public:
    explicit ExposureSum(std::size_t pixels);

    /// Call from the brightest shot to the darkest: the variance comes from the sum of brighter
    /// shots, so that a shot's noise does not choose its own weight. The `last` shot's value is
    /// used where every shot is over-exposed.
    void add(const Photo& shot, double exposure, const ShotNoise& noise, bool last);

    /// Writes `rgb`, `variance` and `saturated`, in the units of a shot of `exposure`, and consumes
    /// the sums. Returns the number of pixels that every shot over-exposed.
    std::size_t take(double exposure, Photo& merged);

private:
    std::vector<float> sum_, weight_;  // for each sample
    std::vector<float> over_;          // for each pixel
};

}  // namespace culet
