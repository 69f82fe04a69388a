#include "compare/study/picture_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/colour/colour.h"
#include "stone/text/errors.h"

namespace culet {
namespace {

// The stone fills the left half.
Picture grey(float value, int width = 40, int height = 30) {
    Picture picture;
    picture.width = width;
    picture.height = height;
    picture.rgb.assign(3 * picture.pixels(), value);
    for (std::size_t i = 0; i < picture.pixels(); ++i)
        picture.coverage.push_back(static_cast<int>(i) % width < width / 2 ? 1.0f : 0.0f);
    return picture;
}

TEST(PictureError, IsNothingForEqualPictures) {
    const PictureMetric metric(grey(0.5f));
    const PictureError error = metric.error_of(grey(0.5f));
    EXPECT_EQ(metric.stone_pixels(), 600);
    EXPECT_EQ(error.mean, 0);
    EXPECT_EQ(error.rmse, 0);
    EXPECT_FALSE(error.psnr);
    EXPECT_EQ(error.delta_e_mean, 0);
    EXPECT_NEAR(error.flip, 0, 1e-6);
}

// Closed forms: 0.05 of 0.5 is a tenth, white is five times 0.5, and the noise of the encoded
// picture is the difference of the encodings.
TEST(PictureError, OfAnOffsetHasAClosedForm) {
    const PictureMetric metric(grey(0.5f));
    const PictureError error = metric.error_of(grey(0.55f));
    EXPECT_NEAR(error.mean, 0.1, 1e-6);
    EXPECT_NEAR(error.rmse, 0.1, 1e-6);
    ASSERT_TRUE(error.psnr);
    const double apart = srgb_encoded(0.55 / 2.5) - srgb_encoded(0.5 / 2.5);
    EXPECT_NEAR(*error.psnr, -20 * std::log10(apart), 1e-3);
    EXPECT_GT(error.delta_e_mean, 0);
    const PixelMap map = metric.difference(grey(0.55f));
    EXPECT_NEAR(static_cast<double>(map.values.front()), 0.1, 1e-6);
    EXPECT_TRUE(std::isnan(map.values[39]));
}

TEST(PictureError, TellsTheMeanFromTheRootMeanSquare) {
    Picture one_pixel = grey(0.5f);
    for (int c = 0; c < 3; ++c) one_pixel.rgb[static_cast<std::size_t>(c)] = 0.8f;
    const PictureError error = PictureMetric(grey(0.5f)).error_of(one_pixel);
    EXPECT_NEAR(error.mean, 0.6 / 600, 1e-8);
    EXPECT_NEAR(error.rmse, 0.6 / std::sqrt(600.0), 1e-7);
}

TEST(PictureError, DoesNotLookBesideTheStone) {
    Picture other = grey(0.5f);
    other.rgb[3 * 39] = 7;
    EXPECT_EQ(PictureMetric(grey(0.5f)).error_of(other).mean, 0);
}

TEST(PictureError, OfABlackTruthIsInfiniteOrNothing) {
    const PictureMetric metric(grey(0));
    EXPECT_EQ(metric.error_of(grey(0)).mean, 0);
    EXPECT_TRUE(std::isinf(metric.error_of(grey(0.1f)).mean));
}

TEST(PictureError, RefusesPicturesOfAnotherSize) {
    EXPECT_THROW(PictureMetric(grey(0.5f)).error_of(grey(0.5f, 41)), InternalError);
}

}  // namespace
}  // namespace culet
