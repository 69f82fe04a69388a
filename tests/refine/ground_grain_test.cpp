#include "refine/spin/ground_grain.h"

#include <gtest/gtest.h>

#include <cmath>

namespace culet {
namespace {

// Of the ground to the picture and back.
TEST(GroundView, GoesBothWays) {
    const GroundView view({2.3, 0.03, 0.85, 1e-4}, 1.2, 110);
    for (const glm::dvec2 place : {glm::dvec2(0, 0), glm::dvec2(150, -80), glm::dvec2(-200, 240)}) {
        const glm::dvec2 back = view.on_ground(view.in_picture(place));
        EXPECT_NEAR(back.x, place.x, 1e-9);
        EXPECT_NEAR(back.y, place.y, 1e-9);
    }
}

// Closed form: a wide slope of light has no grain; a grain is seen where it lies, and not beneath
// the stone.
TEST(GroundGrain, IsWhatIsSmallerThanLightAndShadow) {
    LevelPicture picture{80, 80, std::vector<std::uint8_t>(3 * 80 * 80)};
    for (int y = 0; y < 80; ++y) {
        for (int x = 0; x < 80; ++x) {
            for (int c = 0; c < 3; ++c)
                picture.rgb[std::size_t(3 * (80 * y + x) + c)] =
                    std::uint8_t(100 + x + (x == 70 && y == 20 ? 60 : 0));
        }
    }
    const cv::Mat grain = ground_grain(picture, {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}});
    EXPECT_NEAR(grain_at(grain, {-25.5, -25.5}), 0, 0.05);
    EXPECT_GT(grain_at(grain, {30.5, 19.5}), 5);
    EXPECT_TRUE(std::isnan(grain_at(grain, {0, 0})));
    EXPECT_TRUE(std::isnan(grain_at(grain, {41, 0})));
}

}  // namespace
}  // namespace culet
