// Post-processing for the eye: glare, sparkle, tone maps, alpha.

#include "render/image/film_look.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <numeric>
#include <random>

#include "render/image/glare.h"
#include "render/image/image_io.h"
#include "render/image/shown_bytes.h"
#include "render/image/sparkle.h"
#include "render/scene/film_io.h"
#include "stone/text/errors.h"
#include "tests/scratch_folder.h"

namespace culet {
namespace {

std::vector<float> noise(const PictureSize& size, unsigned seed) {
    std::mt19937 random(seed);
    std::exponential_distribution<float> value(1);
    std::vector<float> rgb(static_cast<std::size_t>(3 * size.width * size.height));
    for (float& v : rgb) v = value(random);
    return rgb;
}

double sum(const std::vector<float>& rgb) {
    return std::accumulate(rgb.begin(), rgb.end(), 0.0);
}

// Spencer et al. 1995: each part of the point spread is normalised to 1 over the hemisphere. The
// sharp part has 0.384 f0, so 0.478 + 0.138 of the light is scattered, to the 3 % of the paper's
// rounded constants.
TEST(Glare, ScattersWhatThePaperSays) {
    const double to_steradian = std::pow(std::numbers::pi / 180, 2);
    double scattered = 0;
    for (double log_degrees = std::log(1e-6); log_degrees < std::log(90.0); log_degrees += 1e-3) {
        const double degrees = std::exp(log_degrees + 0.5e-3), ring = degrees * 1e-3;
        scattered +=
            scattered_by_the_eye(degrees) * 2 * std::numbers::pi * degrees * ring * to_steradian;
    }
    EXPECT_NEAR(scattered, 0.478 + 0.138, 0.03 * 0.616);
}

// Conservation: what one pixel loses others gain.
TEST(Glare, KeepsTheSumOfTheLightAndAnEvenPicture) {
    for (const PictureSize size : {PictureSize{1, 1}, {7, 3}, {33, 20}, {64, 64}}) {
        std::vector<float> rgb = noise(size, 3);
        const double before = sum(rgb);
        add_glare(rgb, size, 1, 0.05);
        EXPECT_NEAR(sum(rgb), before, 1e-6 * before);
        std::vector<float> even(rgb.size(), 0.7f);
        add_glare(even, size, 1, 0.05);
        for (const float v : even) EXPECT_NEAR(v, 0.7f, 1e-6f);
    }
}

// By the definition, pixel by pixel: far from the light its spread times the pixel's solid angle.
TEST(Glare, OfOneBrightPointIsItsSpread) {
    const PictureSize size{61, 61};
    std::vector<float> rgb(3 * 61 * 61, 0.0f);
    const auto at = [](int x, int y) { return static_cast<std::size_t>(3 * (61 * y + x)); };
    rgb[at(30, 30)] = 1000;
    const double pixel = 0.05, radians = pixel * std::numbers::pi / 180;
    add_glare(rgb, size, 1, pixel);
    for (const auto& [x, y] : {std::pair{50, 30}, {30, 5}, {45, 50}, {0, 0}}) {
        const double degrees = pixel * std::hypot(x - 30, y - 30);
        const double expected = 1000 * scattered_by_the_eye(degrees) * radians * radians;
        EXPECT_NEAR(rgb[at(x, y)], expected, 1e-3 * expected);
        EXPECT_EQ(rgb[at(x, y) + 1], 0.0f);
    }
}

TEST(Sparkle, SpreadsWhatIsOverWhiteAlongTheDiagonals) {
    const PictureSize size{401, 401};
    std::vector<float> rgb(3 * 401 * 401, 0.5f);
    const auto at = [](int x, int y) { return static_cast<std::size_t>(3 * (401 * y + x)); };
    rgb[at(200, 200)] = 11;
    const double before = sum(rgb);
    add_sparkle(rgb, size, 0.5);
    // Half of what exceeds white, 10; no more than e^-25 of it falls outside the picture.
    EXPECT_NEAR(sum(rgb) - before, 5, 1e-3 * 5);
    EXPECT_GT(rgb[at(210, 210)], 0.5f);
    EXPECT_NEAR(rgb[at(210, 210)], rgb[at(190, 210)], 1e-6f);
    EXPECT_NEAR(rgb[at(210, 210)], rgb[at(190, 190)], 1e-6f);
    EXPECT_EQ(rgb[at(210, 200)], 0.5f);
    EXPECT_EQ(rgb[at(210, 210) + 2], 0.5f);
    std::vector<float> dim(3 * 401 * 401, 0.9f);
    const std::vector<float> same = dim;
    add_sparkle(dim, size, 1);
    EXPECT_EQ(dim, same);
}

TEST(ToneMaps, RiseFromBlackAndStayBelowWhite) {
    for (const std::string& name : tone_map_names()) {
        PngLook look;
        look.tone_map = *tone_map_named(name);
        EXPECT_EQ(name_of(look.tone_map), name);
        Picture picture;
        picture.width = 200;
        picture.height = 1;
        for (int i = 0; i < 600; ++i)
            picture.rgb.push_back(i < 3 ? 0.0f : std::exp(static_cast<float>(i / 3 - 100) / 10));
        const std::vector<float> shown = as_shown(picture, look);
        EXPECT_EQ(shown[0], 0.0f);
        for (std::size_t i = 3; i < shown.size(); ++i) {
            EXPECT_GE(shown[i], shown[i - 3]) << name;
            EXPECT_LE(shown[i], 1.0f);
        }
        EXPECT_GT(shown.back(), 0.99f) << name;
    }
    EXPECT_FALSE(tone_map_named("sepia").has_value());
}

// Expectation: the ground shows where the stone does not cover the pixel, by the part uncovered.
TEST(Ground, LiesBehindTheStone) {
    Picture picture;
    picture.width = 3;
    picture.height = 1;
    picture.rgb.assign(9, 0.25f);
    picture.coverage = {0, 0.5f, 1};
    PngLook look;
    look.ground = 0.8;
    look.ground_lit = {0.5f, 1, 1};
    EXPECT_FLOAT_EQ(as_shown(picture, look)[0], 0.4f) << "in the shadow";
    EXPECT_FLOAT_EQ(as_shown(picture, look)[3], 0.65f) << "at the stone's edge";
    EXPECT_FLOAT_EQ(as_shown(picture, look)[6], 0.25f) << "in the stone";
    EXPECT_EQ(shown_bytes(picture, look, false)[0], std::lround(255 * srgb_encoded(0.4f)))
        << "in a file, too";
    look.alpha = true;
    EXPECT_FLOAT_EQ(as_shown(picture, look)[0], 0.25f) << "a transparent ground is none";
}

TEST(Film, IsReadFromASceneAndWrittenToItsPng) {
    const test::ScratchFolder folder;
    const auto film = [&](const std::string& text) {
        std::ofstream(folder / "film.toml") << "[film]\n" << text;
        return read_film(*read_toml(folder / "film.toml").table("film"), {});
    };
    const PngLook look = film("glare = true\nsparkle = 0.5\nalpha = true\ntonemap = \"filmic\"\n");
    EXPECT_EQ(look.glare, 1);
    EXPECT_EQ(look.sparkle, 0.5);
    EXPECT_TRUE(look.alpha);
    EXPECT_EQ(look.tone_map, ToneMap::filmic);
    for (const char* wrong :
         {"glare = -1", "sparkle = nan", "tonemap = \"sepia\"", "grain = 1", "alpha = 3"})
        EXPECT_THROW(film(wrong), InputError) << wrong;

    Picture picture;
    picture.width = 2;
    picture.height = 1;
    picture.rgb = {1, 0.5f, 0.25f, 0, 0, 0};
    picture.coverage = {1, 0};
    PngLook alpha;
    alpha.alpha = true;
    write_picture(picture, folder / "a.png", alpha);
    const ReadPicture read = read_picture(folder / "a.png");
    EXPECT_TRUE(read.had_alpha);
    EXPECT_EQ(read.picture.coverage, picture.coverage);
    EXPECT_NEAR(read.picture.rgb[1], 0.5f, 0.005f);
}

// A display of gamma 2 shows light v for a code of sqrt(v): a quarter of white is code 0.5. The
// file is encoded as sRGB afterwards, so its code is the root.
TEST(ToneMaps, Gamma2WritesTheRootOfTheLight) {
    Picture picture;
    picture.width = 3;
    picture.height = 1;
    picture.rgb = {0.25f, 0.01f, 1.0f, 0.5f, 0.0f, 4.0f, 0.04f, 0.81f, 1e-4f};
    PngLook look;
    look.tone_map = *tone_map_named("gamma2");
    const std::vector<float> shown = as_shown(picture, look);
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const double light = std::min(1.0, static_cast<double>(picture.rgb[i]));
        EXPECT_NEAR(srgb_encoded(static_cast<double>(shown[i])), std::sqrt(light), 1e-5);
    }
}

// Expectation: the definition, value by value.
TEST(ShownBytes, AreWhatIsShownEncodedAndRounded) {
    for (const ToneMap map : {ToneMap::none, ToneMap::reinhard, ToneMap::filmic, ToneMap::gamma2}) {
        Picture picture;
        picture.width = 256;
        picture.height = 128;
        picture.rgb = noise({picture.width, picture.height}, 7);
        for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
            picture.rgb[i] *= std::exp(20 * picture.rgb[i + 1] - 10);
        picture.rgb[0] = -1;
        picture.rgb[1] = std::nanf("");
        picture.rgb[2] = INFINITY;
        PngLook look;
        look.exposure = 0.7;
        look.tone_map = map;
        const std::vector<float> shown = as_shown(picture, look);
        const std::vector<std::uint8_t> bytes = shown_bytes(picture, look, true);
        ASSERT_EQ(bytes.size(), 4 * picture.pixels());
        for (std::size_t i = 0; i < picture.pixels(); ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                ASSERT_EQ(bytes[4 * i + c],
                          std::lround(255 * srgb_encoded(static_cast<double>(shown[3 * i + c]))))
                    << picture.rgb[3 * i + c];
            }
            ASSERT_EQ(bytes[4 * i + 3], 255);
        }
    }
}

}  // namespace
}  // namespace culet
