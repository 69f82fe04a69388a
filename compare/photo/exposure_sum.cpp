#include "compare/photo/exposure_sum.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "render/colour/colour.h"

namespace culet {

namespace {

// Uniform rounding to a step of an 8-bit sRGB file: step^2 / 12.
float rounding_variance(double linear) {
    const double code = srgb_encoded(linear);
    const double step = srgb_decoded(std::min(code + 0.5 / 255, 1.0)) -
                        srgb_decoded(std::max(code - 0.5 / 255, 0.0));
    return static_cast<float>(step * step / 12);
}

}  // namespace

ShotNoise::ShotNoise(double saturation, bool eight_bits)
    : full_(saturation > 0 ? static_cast<float>(saturation) : 1.0f) {
    if (!eight_bits) return;
    rounding_.resize(k_steps + 1);
    for (std::size_t i = 0; i < rounding_.size(); ++i)
        rounding_[i] = rounding_variance(double(i) / k_steps);
}

ExposureSum::ExposureSum(std::size_t pixels)
    : sum_(3 * pixels, 0.0f), weight_(3 * pixels, 0.0f), over_(pixels, 0.0f) {}

void ExposureSum::add(const Photo& shot, double exposure, const ShotNoise& noise, bool last) {
    const auto e = static_cast<float>(exposure);
    const auto add_pixel = [&](std::size_t pixel) {
        float use = unclipped(shot, pixel);
        if (use <= 0) {
            if (!last || weight_[3 * pixel] > 0) return;
            over_[pixel] = use = 1;
        }
        for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
            const float guess = weight_[i] > 0 ? sum_[i] / weight_[i] * e : shot.rgb[i];
            const float weight = use * e / noise.variance(guess);
            sum_[i] += weight * shot.rgb[i];
            weight_[i] += weight * e;
        }
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, over_.size()), [&](const auto& range) {
        for (std::size_t pixel = range.begin(); pixel < range.end(); ++pixel) add_pixel(pixel);
    });
}

std::size_t ExposureSum::take(double exposure, Photo& merged) {
    const auto e = static_cast<float>(exposure);
    for (std::size_t i = 0; i < sum_.size(); ++i) {
        sum_[i] *= e / weight_[i];
        weight_[i] = e * e / weight_[i];
    }
    const auto over = std::count(over_.begin(), over_.end(), 1.0f);
    merged.rgb = std::move(sum_);
    merged.variance = std::move(weight_);
    merged.saturated = std::move(over_);
    return static_cast<std::size_t>(over);
}

}  // namespace culet
