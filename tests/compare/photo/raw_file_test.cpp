// Raw files: linear light, levels and exposure of a hand-made DNG, of which every sample is known.

#include "compare/photo/raw_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "stone/text/errors.h"
#include "tests/compare/photo/synthetic_dng.h"
#include "tests/folder_test.h"

namespace culet {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class RawFiles : public test::FolderTest {
protected:
    fs::path file(const std::string& bytes, const std::string& name = "shot.dng") const {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
        return folder_ / name;
    }
    static const float* at(const Photo& photo, int x, int y) {
        return &photo.rgb[3 * (static_cast<std::size_t>(y) * photo.width + x)];
    }

private:
};

// A ramp of greys: equal channels, proportional to the light, 1 where green clips.
TEST_F(RawFiles, ValuesAreLinearLight) {
    const auto dng = synthetic::grey_dng({}, [](int x, int) { return 0.02 + 0.012 * x; });
    const Photo photo = read_photo(file(synthetic::dng_bytes(dng)));
    ASSERT_EQ(photo.width, 64);
    ASSERT_EQ(photo.height, 48);
    EXPECT_EQ(photo.encoding, "linear raw");
    EXPECT_TRUE(photo.photometric);
    for (int x = 4; x < 60; x += 3) {
        for (int c = 0; c < 3; ++c) {
            // One sensor step of 1 / 15359, twice that in red, and the slope between neighbours.
            EXPECT_NEAR(at(photo, x, 20)[c], 0.02 + 0.012 * x, 0.001) << x << " " << c;
        }
    }
}

TEST_F(RawFiles, OverExposureIsMarkedAtTheSensor) {
    const auto dng = synthetic::grey_dng({}, [](int x, int) { return x < 32 ? 0.4 : 1.3; });
    const Photo photo = read_photo(file(synthetic::dng_bytes(dng)));
    ASSERT_EQ(photo.saturated.size(), 64u * 48u);
    EXPECT_EQ(photo.saturated[20 * 64 + 10], 0);
    EXPECT_EQ(photo.saturated[20 * 64 + 50], 1);
    // Red, at half of green's sensitivity, is not clipped there and keeps its value.
    EXPECT_NEAR(at(photo, 50, 20)[0], 1.3, 0.01);
}

TEST_F(RawFiles, ExposureComesFromTheExactEntry) {
    const auto dng = synthetic::grey_dng({}, [](int, int) { return 0.3; });
    const Photo photo = read_photo(file(synthetic::dng_bytes(dng)));
    EXPECT_DOUBLE_EQ(photo.shot.seconds, 1.0 / 32);  // not 1/30
    EXPECT_EQ(photo.shot.f_number, 8);
    EXPECT_EQ(photo.shot.iso, 200);
    EXPECT_EQ(photo.shot.focal_mm, 100);
    EXPECT_EQ(photo.shot.camera, "culet test");
    EXPECT_DOUBLE_EQ(*exposure_of(photo.shot), 2.0 / 32 / 64);
}

TEST_F(RawFiles, ATurnedCameraGivesAnUprightPicture) {
    synthetic::Dng turned;
    turned.orientation = 6;  // shown a quarter turn clockwise: the left column is on top
    const auto dng = synthetic::grey_dng(turned, [](int x, int) { return x < 20 ? 0.8 : 0.1; });
    const Photo photo = read_photo(file(synthetic::dng_bytes(dng)));
    EXPECT_EQ(photo.width, 48);
    EXPECT_EQ(photo.height, 64);
    EXPECT_NEAR(at(photo, 24, 5)[1], 0.8, 0.01);
    EXPECT_NEAR(at(photo, 24, 58)[1], 0.1, 0.01);
}

TEST_F(RawFiles, WhatCannotBeReadIsNamed) {
    const std::string whole =
        synthetic::dng_bytes(synthetic::grey_dng({}, [](int, int) { return 0.3; }));
    for (const std::string& bytes :
         {std::string(), std::string("not a picture"), whole.substr(0, 200)}) {
        try {
            read_photo(file(bytes));
            FAIL() << bytes.size();
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr("raw file"));
        }
    }
}

}  // namespace
}  // namespace culet
