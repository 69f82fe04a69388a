// White balance, the board and the lens. Expectations: what was painted and projected.

#include "compare/photo/white_balance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/colour/colour.h"
#include "stone/text/errors.h"

namespace culet {
namespace {

using ::testing::HasSubstr;

Photo flat(int width, int height, const Rgb& colour) {
    Photo photo;
    photo.width = width;
    photo.height = height;
    photo.saturation = 1;
    for (int i = 0; i < width * height; ++i)
        for (const double v : colour) photo.rgb.push_back(static_cast<float>(v));
    return photo;
}

void paint(Photo& photo, int x0, int y0, int w, int h, const Rgb& colour) {
    for (int y = y0; y < y0 + h; ++y)
        for (int x = x0; x < x0 + w; ++x)
            for (std::size_t c = 0; c < 3; ++c)
                photo.rgb[3 * (static_cast<std::size_t>(y) * photo.width + x) + c] =
                    static_cast<float>(colour[c]);
}

TEST(WhiteBalance, AGreyCardBecomesGrey) {
    Photo photo = flat(60, 40, {0.8, 0.1, 0.1});
    paint(photo, 10, 8, 20, 20, {0.30, 0.20, 0.10});
    const GreyCard card = measure_grey(photo, {12, 10, 16, 16});
    EXPECT_NEAR(card.gain[0], 2.0 / 3, 1e-6);
    EXPECT_NEAR(card.gain[2], 2.0, 1e-6);
    balance(photo, card.gain);
    const float* rgb = &photo.rgb[3 * (15 * 60 + 15)];
    EXPECT_NEAR(rgb[0], 0.2, 1e-6);
    EXPECT_NEAR(rgb[2], 0.2, 1e-6);
    EXPECT_NEAR(card.unevenness, 0, 1e-6);
}

TEST(WhiteBalance, ACardThatSaysNothingIsRefused) {
    const auto refusal = [](const Photo& photo, const PixelRectangle& card) -> std::string {
        try {
            measure_grey(photo, card);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(refusal(flat(60, 40, {1, 1, 1}), {10, 10, 20, 20}), HasSubstr("over-exposed"));
    EXPECT_THAT(refusal(flat(60, 40, {0, 0, 0}), {10, 10, 20, 20}), HasSubstr("black"));
    for (const PixelRectangle& outside :
         {PixelRectangle{50, 10, 20, 20}, PixelRectangle{-1, 0, 8, 8}, PixelRectangle{0, 0, 2, 2},
          PixelRectangle{0, 0, 2147483647, 8}})
        EXPECT_THAT(refusal(flat(60, 40, {0.5, 0.5, 0.5}), outside), HasSubstr("must lie in"));
}

// The maker's values of the 24 patches, through a warm camera.
TEST(WhiteBalance, AColourChartIsFoundAndNeutralised) {
    constexpr int values[24][3] = {
        {115, 82, 68},   {194, 150, 130}, {98, 122, 157}, {87, 108, 67},   {133, 128, 177},
        {103, 189, 170}, {214, 126, 44},  {80, 91, 166},  {193, 90, 99},   {94, 60, 108},
        {157, 188, 64},  {224, 163, 46},  {56, 61, 150},  {70, 148, 73},   {175, 54, 60},
        {231, 199, 31},  {187, 86, 149},  {8, 133, 161},  {243, 243, 242}, {200, 200, 200},
        {160, 160, 160}, {122, 122, 121}, {85, 85, 85},   {52, 52, 52},
    };
    constexpr double warm[3] = {0.9, 0.7, 0.45};
    Photo photo = flat(900, 640, {0.12, 0.1, 0.07});
    paint(photo, 110, 95, 680, 460, {0.01, 0.01, 0.01});
    for (int patch = 0; patch < 24; ++patch) {
        Rgb colour{};
        for (std::size_t c = 0; c < 3; ++c)
            colour[c] = warm[c] * srgb_decoded(values[patch][c] / 255.0);
        paint(photo, 126 + 110 * (patch % 6), 111 + 110 * (patch / 6), 98, 98, colour);
    }
    const auto chart = find_colour_chart(photo);
    ASSERT_TRUE(chart);
    EXPECT_NEAR(chart->gain[0], 0.7 / 0.9, 0.03);
    EXPECT_NEAR(chart->gain[2], 0.7 / 0.45, 0.05);
    EXPECT_LT(chart->after, 2);
    EXPECT_FALSE(find_colour_chart(flat(300, 200, {0.3, 0.3, 0.3})));
}

}  // namespace
}  // namespace culet
