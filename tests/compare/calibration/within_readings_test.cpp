#include "compare/calibration/picture_comparison.h"

#include <gtest/gtest.h>

#include "compare/report/scores_json.h"
#include "compare/scores/chance.h"
#include "render/colour/colour.h"
#include "tests/compare/synthetic_pictures.h"

namespace culet {
namespace {

// A stone's picture in floats, and the same times `level` with bands of the given relative half
// width.
struct Pair {
    Photo photo, render;
};
Pair pair_of(double level, double half_width) {
    Pair pair;
    pair.photo = pair.render = synthetic::draw({});
    pair.photo.saturation = pair.render.saturation = 0;
    for (std::size_t p = 0; p < pair.render.rgb.size() / 3; ++p) {
        const double light = level * luminance(pair.render.rgb.data() + 3 * p);
        for (const double sigmas : {-2, -1, 1, 2})
            pair.render.bands.push_back(static_cast<float>(light * (1 + sigmas * half_width)));
    }
    return pair;
}

TEST(WithinReadings, ARenderWithoutBandsSaysNothing) {
    Pair pair = pair_of(1, 0.1);
    pair.render.bands.clear();
    EXPECT_FALSE(compare(pair.photo, pair.render).within.has_value());
}

// The photograph is the render at another exposure; the gain makes them equal.
TEST(WithinReadings, TheRenderItselfIsWithin) {
    Pair pair = pair_of(1, 0.1);
    for (float& value : pair.photo.rgb) value *= 0.4f;
    const Comparison found = compare(pair.photo, pair.render);
    ASSERT_TRUE(found.within.has_value());
    EXPECT_GT(found.within->within_one, 0.99);
    EXPECT_NE(scores_json(found, {}).find("\"within_readings\""), std::string::npos);
}

// Bands 1.5 sigma off contain the picture only within two sigma; at 4 sigma off neither does.
TEST(WithinReadings, BandsElsewhereDoNotHoldIt) {
    const Pair near = pair_of(1 / (1 - 1.5 * 0.1), 0.1), far = pair_of(1 / (1 - 4 * 0.1), 0.1);
    const auto found = compare(near.photo, near.render).within;
    ASSERT_TRUE(found.has_value());
    EXPECT_LT(found->within_one, 0.05);
    EXPECT_GT(found->within_two, 0.95);
    EXPECT_LT(compare(far.photo, far.render).within->within_two, 0.05);
}

// Photographs whose pixels are independently off by their bands' sigma: 68.3 and 95.4 in 100. Some
// 20000 pixels give shares to 0.3. The camera's noise is overestimated, since the deviations look
// like noise, which widens the bands by at most root two: 84.3 and 99.5.
TEST(WithinReadings, CountsWhatIsOffBySigma) {
    Pair pair = pair_of(1, 0.05);
    Chance chance(3);
    for (std::size_t p = 0; p < pair.photo.rgb.size() / 3; ++p) {
        const float factor = static_cast<float>(1 + 0.05 * chance.normal());
        for (std::size_t c = 0; c < 3; ++c) pair.photo.rgb[3 * p + c] *= factor;
    }
    const auto found = compare(pair.photo, pair.render).within;
    ASSERT_TRUE(found.has_value());
    EXPECT_GT(found->within_one, 0.673);
    EXPECT_LT(found->within_one, 0.853);
    EXPECT_GT(found->within_two, 0.944);
}

}  // namespace
}  // namespace culet
