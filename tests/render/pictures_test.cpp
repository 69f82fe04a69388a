// Expectations: exact round trips, the sRGB standard's anchors (IEC 61966-2-1), CIE 15's
// chromaticities.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "render/colour/colour.h"
#include "render/image/image_io.h"
#include "stone/text/errors.h"
#include "tests/folder_test.h"

namespace {

using namespace culet;
namespace fs = std::filesystem;

class Pictures : public test::FolderTest {};

Picture gradient(int width, int height) {
    Picture picture;
    picture.width = width;
    picture.height = height;
    for (std::size_t i = 0; i < picture.pixels(); ++i) {
        for (int c = 0; c < 3; ++c) picture.rgb.push_back(static_cast<float>(i * 3 + c) / 37.0f);
        picture.coverage.push_back(static_cast<float>(i % 5) / 4.0f);
    }
    return picture;
}

TEST_F(Pictures, ExrKeepsEveryBitAndTheSpectralPlanes) {
    Picture picture = gradient(7, 5);
    picture.wavelengths_nm = {410, 589.3};
    picture.spectral = {std::vector<float>(35, 0.25f), std::vector<float>(35, 1.5f)};
    write_picture(picture, folder_ / "a.exr");
    const ReadPicture back = read_picture(folder_ / "a.exr");
    EXPECT_EQ(back.picture.rgb, picture.rgb);
    EXPECT_EQ(back.picture.coverage, picture.coverage);
    EXPECT_EQ(back.picture.wavelengths_nm, picture.wavelengths_nm);
    EXPECT_EQ(back.picture.spectral, picture.spectral);
    std::ifstream file(folder_ / "a.exr", std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    EXPECT_NE(bytes.find("S0.589,300nm"), std::string::npos);
    EXPECT_NE(bytes.find("S0.410,000nm"), std::string::npos);
}

TEST_F(Pictures, PngIsSrgbWithItsExposureInATextChunk) {
    Picture picture;
    picture.width = 3;
    picture.height = 1;
    picture.rgb = {0, 0, 0, 0.25f, 0.25f, 0.25f, 4, 4, 4};
    PngLook look;
    look.exposure = 2;
    write_picture(picture, folder_ / "a.png", look);
    const ReadPicture back = read_picture(folder_ / "a.png");
    EXPECT_TRUE(back.was_encoded);
    // Linear 0.5 is 188/255 in sRGB (0.7354).
    EXPECT_NEAR(back.picture.rgb[3], srgb_decoded(188.0 / 255), 1e-6);
    EXPECT_EQ(back.picture.rgb[6], 1.0f);
    std::ifstream file(folder_ / "a.png", std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    EXPECT_NE(bytes.find(std::string("culet:exposure\0", 15) + "2"), std::string::npos);
}

TEST_F(Pictures, HdrIsWithinItsOnePerCent) {
    const Picture picture = gradient(16, 9);
    write_picture(picture, folder_ / "a.hdr");
    const ReadPicture back = read_picture(folder_ / "a.hdr");
    for (std::size_t i = 0; i < picture.pixels(); ++i) {
        // RGBE shares the exponent of the brightest channel: accurate to 1/256 of it.
        EXPECT_NEAR(back.picture.rgb[3 * i], picture.rgb[3 * i],
                    picture.rgb[3 * i + 2] / 128 + 1e-6);
    }
}

TEST_F(Pictures, WhatIsNoPictureEndsInOneClearLine) {
    const auto message = [](const fs::path& file) {
        try {
            read_picture(file);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const auto write = [&](const char* name, const std::string& bytes) {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
        return folder_ / name;
    };
    write_picture(gradient(40, 30), folder_ / "whole.exr");
    std::ifstream file(folder_ / "whole.exr", std::ios::binary);
    const std::string whole((std::istreambuf_iterator<char>(file)), {});
    std::vector<fs::path> bad{folder_.path(),
                              folder_ / "missing.exr",
                              write("empty.exr", ""),
                              write("text.png", "hello"),
                              write("half.exr", whole.substr(0, whole.size() / 2)),
                              write("magic.exr", whole.substr(0, 4)),
                              write("magic.png", "\x89PNG\r\n\x1a\n")};
    // A header that claims 2^31 pixels a side.
    std::string huge = whole;
    const std::size_t window = huge.find("dataWindow");
    ASSERT_NE(window, std::string::npos);
    const std::size_t value = window + 11 + 6 + 4;  // name, type "box2i", size
    for (std::size_t i = 8; i < 16; ++i) huge[value + i] = i % 4 == 3 ? '\x3f' : '\xff';
    bad.push_back(write("huge.exr", huge));
    // A single tile of 2^30 pixels a side.
    std::string tile = whole;
    const std::size_t tiles = tile.find("compression");
    const std::string attribute("tiles\0tiledesc\0\x09\0\0\0\0\0\0\x40\0\0\0\x40\0", 28);
    tile.insert(tiles, attribute);
    tile[5] = 2;
    bad.push_back(write("tile.exr", tile));
    // An offset table whose first entry is 3 below the largest 64-bit number: the two blocks of 16
    // rows begin directly after the table.
    std::string wild = whole;
    for (std::size_t at = 8; at + 16 < whole.size(); ++at) {
        std::uint64_t offset = 0;
        std::memcpy(&offset, whole.data() + at, 8);
        if (offset == at + 16) {
            wild.replace(at, 8, "\xfd" + std::string(7, '\xff'));
            break;
        }
    }
    ASSERT_NE(wild, whole);
    bad.push_back(write("wild.exr", wild));
    for (const fs::path& path : bad) {
        const std::string line = message(path);
        EXPECT_NE(line, "") << path;
        EXPECT_EQ(line.find('\n'), std::string::npos) << path;
    }
    EXPECT_THROW(write_picture(gradient(2, 2), folder_ / "a.gif"), InputError);
    EXPECT_THROW(write_picture(gradient(2, 2), folder_ / "no" / "a.exr"), InputError);
    EXPECT_FALSE(fs::exists(folder_ / "a.gif"));
}

TEST(Colour, FlatLightIsWhiteToTheBit) {
    for (const int count : {1, 2, 3, 7, 15, 31}) {
        std::vector<double> nm;
        for (int i = 0; i < count; ++i) nm.push_back(420 + 250.0 * i / std::max(1, count - 1));
        const WavelengthSet set(nm);
        const std::vector<double> ones(count, 1.0);
        EXPECT_EQ(set.rgb_of(ones.data()), (Rgb{1, 1, 1})) << count;
        for (double v : set.spectrum_of({0.7, 0.7, 0.7}))
            EXPECT_NEAR(v, count == 1 ? 0.7 : 0.7, 1e-15);
    }
}

TEST(Colour, RgbLightsComeBackThroughEveryWavelengthSet) {
    const unsigned seed = 1931;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0, 2);
    for (const int count : {3, 4, 8, 15, 31}) {
        std::vector<double> nm;
        for (int i = 0; i < count; ++i) nm.push_back(410 + 280.0 * i / (count - 1));
        const WavelengthSet set(nm);
        for (int draw = 0; draw < 20; ++draw) {
            const Rgb rgb{uniform(random), uniform(random), uniform(random)};
            const Rgb back = set.rgb_of(set.spectrum_of(rgb).data());
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(back[c], rgb[c], 1e-11) << count << " seed " << seed;
        }
        for (std::size_t i = 0; i < nm.size(); ++i) {
            EXPECT_NEAR(set.primaries()[0][i] + set.primaries()[1][i] + set.primaries()[2][i], 1,
                        1e-12);
        }
    }
}

TEST(Colour, SpectraOfLightsAreNoDarkerThanBlack) {
    // Light cannot be negative; with fewer than about ten nodes the exact inverse is (-1 for
    // three).
    for (const int count : {15, 31, 81, 400}) {
        std::vector<double> nm;
        for (int i = 0; i < count; ++i) nm.push_back(400 + 300.0 * i / (count - 1));
        const WavelengthSet set(nm);
        for (const auto& primary : set.primaries()) {
            EXPECT_GE(*std::min_element(primary.begin(), primary.end()), -1e-12) << count;
            EXPECT_LE(*std::max_element(primary.begin(), primary.end()), 1 + 1e-12) << count;
        }
        const Rgb back = set.rgb_of(set.spectrum_of({1, 0.5, 0.25}).data());
        EXPECT_NEAR(back[0], 1, 1e-11);
        EXPECT_NEAR(back[1], 0.5, 1e-11);
        EXPECT_NEAR(back[2], 0.25, 1e-11);
    }
}

TEST(Colour, TwoWavelengthsTellRedFromBlue) {
    // Two wavelengths cannot hold three numbers, but they keep the order of the colours.
    const WavelengthSet set({460, 610});
    const std::vector<double> red = set.spectrum_of({1, 0, 0}), blue = set.spectrum_of({0, 0, 1});
    EXPECT_GT(red[1], 2 * std::abs(red[0]));
    EXPECT_GT(blue[0], 2 * std::abs(blue[1]));
    for (double v : set.spectrum_of({0.3, 0.3, 0.3})) EXPECT_NEAR(v, 0.3, 1e-15);
}

TEST(Colour, WavelengthsThatNobodySeesGiveGreyNotGarbage) {
    for (const std::vector<double>& nm :
         {std::vector<double>{1000, 1100}, std::vector<double>{900, 1000, 1100, 1200}}) {
        const WavelengthSet set(nm);
        for (const Rgb& rgb : {Rgb{1, 0, 0}, Rgb{0.2, 0.4, 0.8}}) {
            for (double v : set.spectrum_of(rgb)) {
                EXPECT_GE(v, -1e-9);
                EXPECT_LE(v, 1 + 1e-9);
            }
        }
    }
}

TEST(Colour, IlluminantsHaveTheirPublishedChromaticity) {
    // CIE 15: A at x, y = 0.44757, 0.40745; D65 is this program's white.
    std::vector<double> nm;
    for (int i = 0; i <= 80; ++i) nm.push_back(380 + 5 * i);
    const WavelengthSet set(nm);
    const auto xyz = xyz_of_rgb(set.rgb_of(set.illuminant_relative("A").data()));
    const double sum = xyz[0] + xyz[1] + xyz[2];
    // White is sRGB's D65 to four digits here, which moves A by as much.
    EXPECT_NEAR(xyz[0] / sum, 0.44757, 3e-4);
    EXPECT_NEAR(xyz[1] / sum, 0.40745, 3e-4);
    EXPECT_NEAR(xyz[1], 1, 2e-3) << "luminance 1";
    for (double v : set.illuminant_relative("D65")) EXPECT_NEAR(v, 1, 1e-15);
}

TEST(Colour, SrgbEncodingHasTheStandardsAnchors) {
    EXPECT_EQ(srgb_encoded(0), 0);
    EXPECT_NEAR(srgb_encoded(1), 1, 1e-15);
    EXPECT_NEAR(srgb_encoded(0.0031308), 0.04045, 1e-5);
    EXPECT_NEAR(srgb_encoded(0.214041), 0.5, 1e-6);
    for (double v = 0; v <= 1; v += 0.01) EXPECT_NEAR(srgb_decoded(srgb_encoded(v)), v, 1e-7);
}

}  // namespace
