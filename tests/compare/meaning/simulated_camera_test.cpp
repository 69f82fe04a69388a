#include "compare/meaning/simulated_camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/colour.h"
#include "tests/compare/synthetic_pictures.h"

namespace culet {
namespace {

Photo grey(float value) {
    Photo photo = synthetic::flat(64, 64, value);
    photo.saturation = 0;
    photo.coverage.assign(64 * 64, 1.0f);
    return photo;
}

// Shot noise of a level of 0.4 x 10000 electrons, and 6 of read noise: sqrt(4000 + 36) / 10000. The
// variance of 12288 samples is known to sqrt(2 / 12288) = 1.3 %; five of them.
TEST(SimulatedCamera, has_the_noise_of_its_electrons) {
    CameraModel camera;
    camera.bits = 0;
    camera.clips = false;
    camera.gain = {2, 2, 2};
    camera.psf_px = 0;
    const Photo photo = photographed(grey(0.2f), camera, 1);
    double sum = 0, squares = 0;
    for (const float v : photo.rgb) {
        sum += static_cast<double>(v);
        squares += static_cast<double>(v) * static_cast<double>(v);
    }
    const double n = static_cast<double>(photo.rgb.size()), mean = sum / n;
    const double variance = squares / n - mean * mean;
    EXPECT_NEAR(mean, 0.4, 5 * std::sqrt(variance / n));
    EXPECT_NEAR(variance / (4036.0 / 1e8), 1, 0.065);
}

TEST(SimulatedCamera, writes_whole_steps_and_clips) {
    CameraModel camera;
    camera.gain = {1, 3, 1};
    const Photo photo = photographed(grey(0.5f), camera, 2);
    EXPECT_EQ(photo.saturation, 1);
    for (std::size_t i = 0; i < photo.rgb.size(); i += 3) {
        const double steps = srgb_encoded(static_cast<double>(photo.rgb[i])) * 255;
        EXPECT_NEAR(steps, std::round(steps), 1e-3);
        EXPECT_EQ(photo.rgb[i + 1], 1.0f);
    }
}

TEST(SimulatedCamera, is_repeatable_and_keeps_the_coverage_where_asked) {
    CameraModel camera;
    const Photo a = photographed(grey(0.3f), camera, 3), b = photographed(grey(0.3f), camera, 3),
                c = photographed(grey(0.3f), camera, 4);
    EXPECT_EQ(a.rgb, b.rgb);
    EXPECT_NE(a.rgb, c.rgb);
    EXPECT_TRUE(a.coverage.empty());
    camera.outline_from_background = false;
    EXPECT_EQ(photographed(grey(0.3f), camera, 3).coverage.size(), 64u * 64u);
}

TEST(SimulatedCamera, meters_another_light_like_the_model) {
    const Photo dim = grey(0.1f), model = grey(0.4f);
    EXPECT_NEAR(exposure_like(dim, model), 4, 1e-5);
    EXPECT_EQ(exposure_like(grey(0), model), 1);
}

}  // namespace
}  // namespace culet
