// Merged exposures. Expectations: the scene that the shots were made from, and the statistics of
// the added noise.

#include "compare/photo/bracket.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "compare/photo/exposure.h"
#include "render/colour/colour.h"
#include "stone/text/errors.h"

namespace culet {
namespace {

using ::testing::HasSubstr;

constexpr int k_width = 160, k_height = 120;

// A contrast of two thousand to one, with texture to align by.
double scene(double x, double y, std::size_t channel) {
    const double soft = std::sin(0.31 * x + 0.11 * y) + std::sin(0.17 * y - 0.05 * x) +
                        0.7 * std::sin(0.9 * x) * std::sin(0.8 * y + 1);
    return std::exp2(11.0 * x / k_width - 4 + 0.35 * soft) *
           (1 + 0.1 * static_cast<double>(channel));
}

struct Camera {
    double exposure = 1, dx = 0, dy = 0;
    bool eight_bits = false;
    std::function<double(double)> curve = [](double v) { return srgb_encoded(v); };
};

Photo photo_by(const Camera& camera, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    Photo photo;
    photo.width = k_width;
    photo.height = k_height;
    photo.saturation = 1;
    photo.encoding = camera.eight_bits ? "8-bit sRGB JPEG" : "linear raw";
    for (int y = 0; y < k_height; ++y) {
        for (int x = 0; x < k_width; ++x) {
            for (std::size_t c = 0; c < 3; ++c) {
                const double light = scene(x - camera.dx, y - camera.dy, c) * camera.exposure;
                const double electrons = 20000 * light;
                double v = (electrons + std::sqrt(electrons + 16) * normal(random)) / 20000;
                v = std::clamp(v, 0.0, 1.0);
                if (camera.eight_bits) v = srgb_decoded(std::round(255 * camera.curve(v)) / 255);
                photo.rgb.push_back(static_cast<float>(v));
            }
        }
    }
    return photo;
}

BracketShot shot_of(const Photo& photo, double exposure, unsigned number) {
    return {"shot" + std::to_string(number), exposure, [photo] { return photo; }};
}

BracketShot shot(const Camera& camera, unsigned seed) {
    return shot_of(photo_by(camera, seed), camera.exposure, seed);
}

struct Off {
    double mean = 0, bias = 0;
};
Off off(const Photo& photo, double first_exposure, int from = 8, int to = k_width - 8) {
    double sum = 0, bias = 0, n = 0;
    for (int y = 8; y < k_height - 8; ++y) {
        for (int x = from; x < to; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * k_width + x;
            if (photo.saturated[i] > 0) continue;
            for (std::size_t c = 0; c < 3; ++c) {
                const double stops =
                    std::log2(photo.rgb[3 * i + c] / (scene(x, y, c) * first_exposure));
                sum += std::abs(stops);
                bias += stops;
                ++n;
            }
        }
    }
    return {sum / n, bias / n};
}

TEST(Bracket, ThreeExposuresAreTheScene) {
    const Bracket merged =
        merge_bracket({shot({1.0 / 16}, 1), shot({1.0 / 128}, 2), shot({1.0}, 3)});
    const Off error = off(merged.photo, 1.0 / 16);
    EXPECT_LT(error.mean, 0.02);
    EXPECT_LT(std::abs(error.bias), 0.003);
    for (const double ratio : merged.exposure_ratios) EXPECT_NEAR(ratio, 1, 0.02);
    for (const FrameShift& shift : merged.shifts) EXPECT_LT(std::hypot(shift.x, shift.y), 0.15);
    EXPECT_EQ(merged.photo.saturation, 0);
}

// The variance must be honest: the mean of (difference^2 / variance) is 1.
TEST(Bracket, TheVarianceIsTheNoise) {
    const Bracket merged =
        merge_bracket({shot({1.0 / 16}, 4), shot({1.0 / 128}, 5)}, {Response::as_read, false});
    double sum = 0, n = 0;
    for (int y = 0; y < k_height; ++y) {
        for (int x = 20; x < k_width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * k_width + x;
            if (merged.photo.saturated[i] > 0) continue;
            for (std::size_t c = 0; c < 3; ++c) {
                const double difference = merged.photo.rgb[3 * i + c] - scene(x, y, c) / 16;
                sum += difference * difference / merged.photo.variance[3 * i + c];
                ++n;
            }
        }
    }
    EXPECT_NEAR(sum / n, 1, 0.15);
}

TEST(Bracket, AKnockBetweenShotsIsFoundAndPutRight) {
    Camera second{1.0 / 64, 2.6, -1.4};
    const Bracket merged = merge_bracket({shot({1.0 / 16}, 6), shot(second, 7)});
    EXPECT_NEAR(merged.shifts[1].x, 2.6, 0.15);
    EXPECT_NEAR(merged.shifts[1].y, -1.4, 0.15);
    ASSERT_FALSE(merged.notes.empty());
    EXPECT_THAT(merged.notes[0], HasSubstr("moved by up to"));
}

// Light that only rises to one side looks the same after a shift and a gain: it cannot determine a
// shift.
TEST(Bracket, AWallWithoutStructureMovesNothing) {
    std::vector<BracketShot> shots;
    for (unsigned k = 0; k < 2; ++k) {
        const double exposure = std::exp2(-double(k));
        Photo wall = photo_by({1.0}, k);
        std::mt19937_64 random(k);
        std::normal_distribution<double> noise(0, 0.002);
        for (std::size_t i = 0; i < wall.rgb.size(); ++i) {
            const double x = double(i / 3 % std::size_t(k_width)) / k_width;
            wall.rgb[i] =
                float(std::clamp(exposure * std::exp2(6 * x - 5) + noise(random), 0., 1.));
        }
        shots.push_back(shot_of(wall, exposure, k));
    }
    for (const FrameShift& shift : merge_bracket(shots).shifts)
        EXPECT_LT(std::hypot(shift.x, shift.y), 0.5);
}

TEST(Bracket, ShotsAreReadWhenTheyAreNeeded) {
    int read = 0;
    std::vector<BracketShot> shots;
    for (const double exposure : {1.0 / 64, 1.0, 1.0 / 8}) {
        BracketShot one = shot({exposure}, 7);
        one.read = [&read, inner = one.read] {
            ++read;
            return inner();
        };
        shots.push_back(std::move(one));
    }
    merge_bracket(shots);
    EXPECT_EQ(read, 3) << "small ones are kept";
}

TEST(Bracket, WhatEveryShotOverExposesIsMarked) {
    const Bracket merged = merge_bracket({shot({1.0}, 8), shot({0.25}, 9)});
    EXPECT_EQ(merged.photo.saturated[60 * k_width + 5], 0);
    EXPECT_EQ(merged.photo.saturated[60 * k_width + k_width - 2], 1);
    EXPECT_NEAR(merged.photo.rgb[3 * (60 * k_width + k_width - 2)], 4, 0.01);  // at least that
}

// A camera whose curve is not sRGB's: with the curve found from seven JPEGs, ratios of light are
// right.
TEST(Bracket, AnUnknownToneCurveIsFoundFromTheSeries) {
    std::vector<BracketShot> shots;
    for (int k = 0; k < 7; ++k) {
        Camera camera;
        camera.exposure = std::exp2(-1.5 * k + 1);
        camera.eight_bits = true;
        camera.curve = [](double v) { return std::pow(v, 1 / 1.6) * (1.15 - 0.15 * v); };
        shots.push_back(shot(camera, 20 + static_cast<unsigned>(k)));
    }
    const Bracket found = merge_bracket(shots);
    EXPECT_EQ(found.response, Response::calibrated);
    EXPECT_TRUE(found.photo.photometric);
    // The curve inverts the camera's values: for green at a quarter of white and at white.
    ASSERT_TRUE(found.curve);
    const auto written = [](double light) {
        return std::size_t(std::lround(255 * std::pow(light, 1 / 1.6) * (1.15 - 0.15 * light)));
    };
    const auto& green = (*found.curve)[1];
    EXPECT_NEAR(std::log2(green[written(0.5)] / green[written(0.125)]), 2, 0.12);
    EXPECT_FLOAT_EQ(green[255], 1);
    const Bracket assumed = merge_bracket(shots, {Response::as_read, true});
    // The scale of an estimated curve is free: only the spread about the mean counts.
    const auto spread = [](const Photo& photo) {
        double sum = 0, squares = 0, n = 0;
        for (int y = 10; y < k_height - 10; ++y) {
            for (int x = 20; x < k_width - 10; ++x) {
                const std::size_t i = static_cast<std::size_t>(y) * k_width + x;
                if (photo.saturated[i] > 0) continue;
                const double stops = std::log2(photo.rgb[3 * i + 1] / scene(x, y, 1));
                sum += stops;
                squares += stops * stops;
                ++n;
            }
        }
        return std::sqrt(squares / n - sum * sum / (n * n));
    };
    EXPECT_LT(spread(found.photo), 0.06);
    EXPECT_LT(spread(found.photo), spread(assumed.photo) / 2);
}

// Five JPEGs of grey and coloured light. The curve is the same for all channels, so ratios of 1 :
// 1.1 : 1.2 in the scene stay in the merged picture (a grey card's gains depend on them). Separate
// curves per channel missed this by a third.
TEST(Bracket, AToneCurveThatIsFoundKeepsTheWhiteBalance) {
    std::vector<BracketShot> shots;
    for (int k = 0; k < 5; ++k) {
        Camera camera;
        camera.exposure = std::exp2(-2 * k + 2);
        camera.eight_bits = true;
        shots.push_back(shot(camera, 40 + static_cast<unsigned>(k)));
    }
    const Bracket found = merge_bracket(shots);
    ASSERT_EQ(found.response, Response::calibrated);
    std::array<double, 3> sums{};
    for (int y = 40; y < 60; ++y)
        for (int x = 60; x < 80; ++x)
            for (std::size_t c = 0; c < 3; ++c)
                sums[c] += double(found.photo.rgb[3 * std::size_t(y * k_width + x) + c]);
    EXPECT_NEAR(sums[1] / sums[0], 1.1, 0.03);
    EXPECT_NEAR(sums[1] / sums[2], 1.1 / 1.2, 0.03);
}

TEST(Bracket, ASingleJpegIsForShapesOnly) {
    Photo only = photo_by({1.0 / 64, 0, 0, true}, 30);
    only.photometric = false;
    only.not_photometric = "a JPEG";
    const Bracket merged = merge_bracket({shot_of(only, 1, 30)});
    EXPECT_FALSE(merged.photo.photometric);
    EXPECT_EQ(merged.photo.not_photometric, "a JPEG");
}

TEST(Bracket, BadSeriesAreRefused) {
    const auto refusal = [](const std::vector<BracketShot>& shots) -> std::string {
        try {
            merge_bracket(shots);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_FALSE(refusal({}).empty());
    EXPECT_THAT(refusal({shot({1}, 1), shot({1}, 2)}), HasSubstr("same exposure"));
    Photo small = photo_by({0.5}, 3);
    small.width = 10;
    EXPECT_THAT(refusal({shot({1}, 1), shot_of(small, 0.5, 3)}), HasSubstr("one size"));
    Photo black = photo_by({0.5}, 4);
    for (float& v : black.rgb) v = 0;
    EXPECT_THAT(refusal({shot({1}, 1), shot_of(black, 0.5, 4)}), HasSubstr("black"));
    Photo broken = photo_by({0.5}, 5);
    broken.not_finite = 3;
    EXPECT_THAT(refusal({shot_of(broken, 0.5, 5)}), HasSubstr("NaN"));
    EXPECT_THROW(merge_bracket({shot({1}, 1), shot({2}, 2)}, {Response::calibrated, true}),
                 InputError)
        << "raw files have no response to find";
}

TEST(Exposures, AreReadAsPeopleWriteThem) {
    EXPECT_DOUBLE_EQ(parse_exposure("1/125"), 1.0 / 125);
    EXPECT_DOUBLE_EQ(parse_exposure("0.008"), 0.008);
    EXPECT_DOUBLE_EQ(parse_exposure("2 s"), 2);
    EXPECT_DOUBLE_EQ(parse_exposure("-2EV"), 0.25);
    EXPECT_DOUBLE_EQ(parse_exposure("+1ev"), 2);
    for (const char* wrong : {"", "0", "-1", "1/0", "fast", "1/2/3", "nan", "1e999"})
        EXPECT_THROW(parse_exposure(wrong), InputError) << wrong;
}

TEST(Exposures, DamagedExifIsNone) {
    for (const std::string& bytes :
         {std::string("II*\0\xff\xff\xff\x7f", 8), std::string("MM\0*\0\0\0\x08\xff\xff", 10),
          std::string("\xff\xd8\xff\xe1\0\x10"
                      "Exif\0\0II*\0\1\0",
                      16),
          std::string()}) {
        EXPECT_FALSE(shot_data(bytes).known());
    }
}

}  // namespace
}  // namespace culet
