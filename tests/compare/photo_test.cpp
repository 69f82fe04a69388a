#include "compare/photo/photo.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "render/colour/colour.h"
#include "render/image/picture_format.h"
#include "stone/text/errors.h"
#include "tests/folder_test.h"

namespace culet {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class PhotoFiles : public test::FolderTest {
protected:
    // Without the file's name, which might contain the expected words.
    std::string complaint(const std::string& name) const {
        try {
            read_photo(file(name));
        } catch (const InputError& error) {
            const std::string message = error.what(), path = file(name);
            EXPECT_EQ(message.substr(0, path.size()), path);
            return message.substr(path.size());
        }
        return "read";
    }
};

TEST_F(PhotoFiles, EightAndSixteenBitsAreDecodedAlike) {
    cv::Mat eight(2, 3, CV_8UC3, cv::Scalar(64, 128, 255)), sixteen;  // blue, green, red
    eight.convertTo(sixteen, CV_16U, 257);
    cv::imwrite(file("8.png"), eight);
    cv::imwrite(file("16.png"), sixteen);
    cv::imwrite(file("16.tif"), sixteen);
    for (const char* name : {"8.png", "16.png", "16.tif"}) {
        const Photo photo = read_photo(file(name));
        EXPECT_EQ(photo.width, 3);
        EXPECT_EQ(photo.height, 2);
        EXPECT_EQ(photo.saturation, 1);
        EXPECT_NEAR(photo.rgb[0], 1, 1e-6);
        EXPECT_NEAR(photo.rgb[1], 0.2158605, 1e-6);
        EXPECT_NEAR(photo.rgb[2], srgb_decoded(64 / 255.0), 1e-6);
        EXPECT_TRUE(photo.coverage.empty());
    }
}

TEST_F(PhotoFiles, GreyPicturesHaveThreeEqualChannels) {
    cv::imwrite(file("grey.png"), cv::Mat(2, 2, CV_8U, cv::Scalar(128)));
    const Photo photo = read_photo(file("grey.png"));
    ASSERT_EQ(photo.rgb.size(), 12u);
    for (const float v : photo.rgb) EXPECT_NEAR(v, 0.2158605, 1e-6);
}

TEST_F(PhotoFiles, FloatsAreLinearAndKeepTheirRange) {
    cv::Mat floats(2, 2, CV_32FC3, cv::Scalar(0.25, 3, 40));
    floats.at<cv::Vec3f>(0, 0) = {-1, std::nanf(""), 7};
    cv::imwrite(file("a.exr"), floats);
    const Photo photo = read_photo(file("a.exr"));
    EXPECT_EQ(photo.saturation, 0);
    EXPECT_EQ(photo.rgb[0], 7);
    EXPECT_EQ(photo.rgb[1], 0);
    EXPECT_EQ(photo.rgb[2], 0);
    EXPECT_EQ(photo.rgb[3], 40);
    EXPECT_EQ(photo.notes.size(), 2u);
}

TEST_F(PhotoFiles, AlphaIsTheStonesCoverage) {
    cv::Mat with_alpha(1, 2, CV_8UC4, cv::Scalar(10, 20, 30, 0));
    with_alpha.at<cv::Vec4b>(0, 1)[3] = 255;
    cv::imwrite(file("a.png"), with_alpha);
    const Photo photo = read_photo(file("a.png"));
    ASSERT_EQ(photo.coverage.size(), 2u);
    EXPECT_EQ(photo.coverage[0], 0);
    EXPECT_EQ(photo.coverage[1], 1);
}

// EXIF orientation 6: the camera was turned, so the picture is shown a quarter turn clockwise.
TEST_F(PhotoFiles, AJpegIsTurnedUpright) {
    cv::Mat wide(16, 48, CV_8UC3, cv::Scalar(0, 0, 0));
    wide.colRange(0, 16).setTo(cv::Scalar(255, 255, 255));
    std::vector<unsigned char> jpeg;
    cv::imencode(".jpg", wide, jpeg);
    const unsigned char exif[] = {0xff, 0xe1, 0, 34, 'E', 'x', 'i', 'f', 0, 0,    'M', 'M',
                                  0,    42,   0, 0,  0,   8,   0,   1,   1, 0x12, 0,   3,
                                  0,    0,    0, 1,  0,   6,   0,   0,   0, 0,    0,   0};
    std::string bytes(jpeg.begin(), jpeg.begin() + 2);
    bytes.append(reinterpret_cast<const char*>(exif), sizeof exif);
    bytes.append(jpeg.begin() + 2, jpeg.end());
    write("turned.jpg", bytes);
    const Photo photo = read_photo(file("turned.jpg"));
    EXPECT_EQ(photo.width, 16);
    EXPECT_EQ(photo.height, 48);
    EXPECT_GT(photo.rgb[0], 0.9f);  // white on top
    EXPECT_LT(photo.rgb[photo.rgb.size() - 1], 0.1f);
}

TEST_F(PhotoFiles, WhatIsNoPictureIsNamed) {
    EXPECT_THAT(complaint("missing.png"), HasSubstr("no such file"));
    fs::create_directory(file("folder.png"));
    EXPECT_THAT(complaint("folder.png"), HasSubstr("folder"));
    write("empty.png", "");
    EXPECT_THAT(complaint("empty.png"), HasSubstr("empty"));
    write("text.png", "not a picture at all");
    EXPECT_THAT(complaint("text.png"), HasSubstr("is not a picture"));
    write("raw.cr2", std::string("II\x1a\0raw", 7));
    EXPECT_THAT(complaint("raw.cr2"), HasSubstr("raw files"));
}

TEST_F(PhotoFiles, BrokenPicturesAreNamed) {
    cv::Mat some(64, 64, CV_8UC3, cv::Scalar(1, 2, 3));
    cv::randu(some, 0, 255);
    for (const char* extension : {".png", ".exr", ".hdr"}) {
        cv::Mat floats;
        some.convertTo(floats, CV_32F, 1 / 255.0);
        const std::string name = std::string("cut") + extension;
        cv::imwrite(file(name), extension == std::string(".png") ? some : floats);
        std::ifstream in(file(name), std::ios::binary);
        std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
        for (const std::size_t keep : {std::size_t{12}, std::size_t{60}, bytes.size() / 8}) {
            write(name, bytes.substr(0, keep));
            EXPECT_THAT(complaint(name),
                        AnyOf(HasSubstr("cut off"), HasSubstr("too early"), HasSubstr("broken")))
                << name << " " << keep;
        }
    }
}

TEST_F(PhotoFiles, AbsurdSizesAreRefusedBeforeAnythingIsAllocated) {
    std::string png("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\1\0\0\0\1\0\0\x08\2\0\0\0\xe3\xe6\xa7\xb4",
                    33);
    write("huge.png", png);
    EXPECT_THAT(complaint("huge.png"), HasSubstr("65536 x 65536"));
    write("huge.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 99999 +X 99999\n");
    EXPECT_THAT(complaint("huge.hdr"), HasSubstr("99999 x 99999"));
}

TEST_F(PhotoFiles, AMaskOfAnotherSizeIsRefused) {
    cv::imwrite(file("mask.png"), cv::Mat(4, 5, CV_8U, cv::Scalar(255)));
    EXPECT_EQ(read_mask(file("mask.png"), 5, 4).size(), 20u);
    try {
        read_mask(file("mask.png"), 4, 5);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("5 x 4"));
        EXPECT_THAT(error.what(), HasSubstr("4 x 5"));
    }
}

TEST_F(PhotoFiles, AMaskIsCutAtHalfOfItsEncodedBrightness) {
    cv::Mat mask(1, 3, CV_8U);
    mask.at<unsigned char>(0, 0) = 120;
    mask.at<unsigned char>(0, 1) = 135;
    mask.at<unsigned char>(0, 2) = 255;
    cv::imwrite(file("mask.png"), mask);
    const auto stone = read_mask(file("mask.png"), 3, 1);
    EXPECT_EQ(stone, (std::vector<float>{0, 1, 1}));
}

TEST(PictureFormat, NeverReadsPastTheEnd) {
    const std::string starts[] = {"\x89PNG\r\n\x1a\n",
                                  "\xff\xd8\xff",
                                  std::string("II*\0", 4),
                                  std::string("MM\0*", 4),
                                  "\x76\x2f\x31\x01",
                                  "#?RADIANCE",
                                  "PF\n"};
    for (const std::string& start : starts) {
        for (std::size_t length = 0; length < 40; ++length) {
            const std::string bytes = start + std::string(length, '\xff');
            EXPECT_FALSE(picture_format(bytes).empty());
        }
    }
    EXPECT_TRUE(picture_format("").empty());
    EXPECT_TRUE(picture_format("PF").empty());
}

}  // namespace
}  // namespace culet
