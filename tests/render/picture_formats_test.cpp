// Files of other programs, and broken files. Expectations: the stored values, decoded by the sRGB
// standard; the formats' rules for sizes, checksums and ends.

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "render/colour/colour.h"
#include "render/image/image_io.h"
#include "stone/text/errors.h"
#include "tests/folder_test.h"

namespace {

using namespace culet;
namespace fs = std::filesystem;

class PictureFormats : public test::FolderTest {
protected:
    static std::string bytes_of(const cv::Mat& image, const char* extension) {
        // TIFF without compression: LogLuv, the default for floats, is lossy.
        std::vector<unsigned char> bytes;
        cv::imencode(extension, image, bytes, {cv::IMWRITE_TIFF_COMPRESSION, 1});
        return {bytes.begin(), bytes.end()};
    }
    ReadPicture read(const char* name, const std::string& bytes) const {
        return read_picture(write(name, bytes));
    }
    std::string refusal(const char* name, const std::string& bytes) const {
        try {
            read(name, bytes);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
};

TEST_F(PictureFormats, GreyAlphaAndSixteenBitAreDecodedFromSrgb) {
    const ReadPicture grey = read("grey.png", bytes_of(cv::Mat(2, 3, CV_8U, 128.0), ".png"));
    EXPECT_TRUE(grey.was_encoded);
    EXPECT_FALSE(grey.had_alpha);
    EXPECT_EQ(grey.white, 1.0f);
    for (int c = 0; c < 3; ++c)
        EXPECT_FLOAT_EQ(grey.picture.at(2, 1)[c], float(srgb_decoded(128 / 255.0)));

    // OpenCV's order is blue, green, red, alpha.
    const cv::Mat colour(1, 1, CV_8UC4, cv::Scalar(10, 20, 200, 51));
    const ReadPicture alpha = read("alpha.png", bytes_of(colour, ".png"));
    ASSERT_TRUE(alpha.had_alpha);
    EXPECT_FLOAT_EQ(alpha.picture.rgb[0], float(srgb_decoded(200 / 255.0)));
    EXPECT_FLOAT_EQ(alpha.picture.rgb[2], float(srgb_decoded(10 / 255.0)));
    EXPECT_FLOAT_EQ(alpha.picture.coverage[0], 0.2f);

    for (const char* extension : {".png", ".tiff"}) {
        const cv::Mat deep(1, 1, CV_16UC3, cv::Scalar(65535, 1000, 30000));
        const ReadPicture sixteen =
            read((std::string("deep") + extension).c_str(), bytes_of(deep, extension));
        EXPECT_FLOAT_EQ(sixteen.picture.rgb[0], float(srgb_decoded(30000 / 65535.0))) << extension;
        EXPECT_FLOAT_EQ(sixteen.picture.rgb[2], 1.0f) << extension;
    }
}

TEST_F(PictureFormats, FloatTiffIsLinear) {
    const cv::Mat image(2, 2, CV_32FC3, cv::Scalar(0.25, 3.5, 1e-3));
    const ReadPicture back = read("float.tiff", bytes_of(image, ".tiff"));
    EXPECT_FALSE(back.was_encoded);
    EXPECT_EQ(back.white, 0.0f);
    EXPECT_EQ(back.picture.rgb[0], 1e-3f);
    EXPECT_EQ(back.picture.rgb[1], 3.5f);
}

cv::Mat two_halves() {
    cv::Mat image(16, 32, CV_8UC3, cv::Scalar(20, 20, 20));
    image.colRange(16, 32).setTo(cv::Scalar(220, 220, 220));
    return image;
}

TEST_F(PictureFormats, AJpegIsTurnedUprightByItsExifTag) {
    // Orientation 6 (EXIF 2.3, 4.6.4): the stored picture is shown turned clockwise by a quarter.
    const std::string exif(
        "\xff\xe1\0\x22"
        "Exif\0\0II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0",
        36);
    std::string bytes = bytes_of(two_halves(), ".jpg");
    const ReadPicture stored = read("stored.jpg", bytes);
    EXPECT_EQ(stored.picture.width, 32);
    bytes.insert(2, exif);
    const ReadPicture shown = read("shown.jpg", bytes);
    ASSERT_EQ(shown.picture.width, 16);
    ASSERT_EQ(shown.picture.height, 32);
    EXPECT_LT(shown.picture.at(8, 2)[0], 0.05f) << "the dark left half has become the top";
    EXPECT_GT(shown.picture.at(8, 29)[0], 0.5f);
}

TEST_F(PictureFormats, CutOffFilesAreRefusedRatherThanHalfGrey) {
    for (const char* extension : {".png", ".jpg"}) {
        cv::Mat noise(60, 80, CV_8UC3);
        cv::theRNG().state = 7;
        cv::randu(noise, 0, 255);
        const std::string bytes = bytes_of(noise, extension);
        EXPECT_EQ(read((std::string("whole") + extension).c_str(), bytes).picture.width, 80);
        for (const double share : {0.2, 0.5, 0.9, 0.999}) {
            const std::string part =
                bytes.substr(0, static_cast<std::size_t>(share * double(bytes.size())));
            EXPECT_NE(refusal((std::string("part") + extension).c_str(), part).find("cut off"),
                      std::string::npos)
                << extension << " " << share;
        }
    }
}

TEST_F(PictureFormats, ADamagedPngIsNoticedByItsChecksum) {
    std::string bytes = bytes_of(two_halves(), ".png");
    bytes[bytes.size() - 20] = static_cast<char>(bytes[bytes.size() - 20] ^ 1);
    EXPECT_NE(refusal("bad.png", bytes).find("damaged"), std::string::npos);
}

TEST_F(PictureFormats, SizesOfHostileHeadersAreRefusedBeforeThereIsRoomForThem) {
    EXPECT_NE(refusal("a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2000000 +X 2000000\n")
                  .find("2000000 x 2000000"),
              std::string::npos);
    EXPECT_NE(refusal("b.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16000 +X 16000\n")
                  .find("cut off"),
              std::string::npos);
    // A JPEG's size is in its start of frame: height, then width, two bytes each.
    std::string jpeg = bytes_of(two_halves(), ".jpg");
    const std::size_t frame = jpeg.find("\xff\xc0");
    ASSERT_NE(frame, std::string::npos);
    jpeg.replace(frame + 5, 4, "\x7f\x7f\x7f\x7f");
    EXPECT_NE(refusal("huge.jpg", jpeg).find("32639 x 32639"), std::string::npos);
    // A TIFF with one directory of three LONG entries: width and height 2^30, and the offset of a
    // strip.
    std::string tiff("II*\0\x08\0\0\0\x03\0", 10);
    tiff += std::string("\0\1\4\0\1\0\0\0\0\0\0\x40", 12);
    tiff += std::string("\1\1\4\0\1\0\0\0\0\0\0\x40", 12);
    tiff += std::string("\x11\1\4\0\1\0\0\0\x08\0\0\0", 12);
    EXPECT_NE(refusal("huge.tiff", tiff + std::string(4, '\0')).find("1073741824"),
              std::string::npos);
}

TEST_F(PictureFormats, EveryPixelThatIsNoNumberIsWrittenAsAColour) {
    Picture picture;
    picture.width = 2;
    picture.height = 1;
    const float inf = std::numeric_limits<float>::infinity();
    picture.rgb = {inf, std::nanf(""), -1, 1e38f, 3e38f, 0.5f};
    for (const ToneMap map : {ToneMap::none, ToneMap::reinhard}) {
        PngLook look;
        look.tone_map = map;
        write_picture(picture, folder_ / "a.png", look);
        const ReadPicture back = read_picture(folder_ / "a.png");
        EXPECT_EQ(back.picture.rgb[0], 1.0f);
        EXPECT_EQ(back.picture.rgb[1], 0.0f);
        EXPECT_EQ(back.picture.rgb[2], 0.0f);
    }
    write_picture(picture, folder_ / "a.hdr");
    for (float v : read_picture(folder_ / "a.hdr").picture.rgb) EXPECT_TRUE(std::isfinite(v));
}

// Rows from the bottom, little endian where the scale is negative (Debevec's format).
TEST_F(PictureFormats, APfmIsReadFromTheBottomUp) {
    const float pixels[2][2][3] = {{{1, 2, 3}, {4, 5, 6}}, {{1e-30f, 0.5f, 7}, {1e30f, 8, 9}}};
    std::string bytes = "PF\n2 2\n-1.0\n";
    bytes.append(reinterpret_cast<const char*>(pixels), sizeof pixels);
    std::ofstream(folder_ / "a.pfm", std::ios::binary) << bytes;
    const ReadPicture read = read_picture(folder_ / "a.pfm");
    ASSERT_EQ(read.picture.width, 2);
    ASSERT_EQ(read.picture.height, 2);
    EXPECT_FALSE(read.was_encoded);
    EXPECT_EQ(read.picture.rgb,
              (std::vector<float>{1e-30f, 0.5f, 7, 1e30f, 8, 9, 1, 2, 3, 4, 5, 6}));
    // A header that promises more data than there is, or has no size.
    for (const char* head : {"PF\n100000 100000\n-1.0\n", "PF\n-1.0\n", "PF\n", "PF\n9 9\n-1\n"}) {
        std::ofstream(folder_ / "b.pfm", std::ios::binary) << head << "abcd";
        EXPECT_THROW(read_picture(folder_ / "b.pfm"), InputError) << head;
    }
}

TEST_F(PictureFormats, TextBeyondAsciiIsStoredAsUtf8) {
    Picture picture;
    picture.width = picture.height = 1;
    picture.rgb = {0, 0, 0};
    write_picture(picture, folder_ / "a.png", {}, {{"culet:scene", "gr\u00fcn.toml"}});
    std::ifstream stream(folder_ / "a.png", std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
    EXPECT_NE(bytes.find(std::string("iTXtculet:scene\0\0\0\0\0gr\u00fcn.toml", 30)),
              std::string::npos);
    // Reading verifies the checksums of all chunks, including those that culet wrote.
    EXPECT_EQ(read_picture(folder_ / "a.png").picture.width, 1);
}

TEST_F(PictureFormats, TheSamePictureGivesTheSameBytes) {
    Picture picture;
    picture.width = 5;
    picture.height = 4;
    picture.rgb.assign(60, 0.3f);
    const auto content = [](const fs::path& file) {
        std::ifstream stream(file, std::ios::binary);
        return std::string((std::istreambuf_iterator<char>(stream)), {});
    };
    for (const char* extension : {".exr", ".png", ".hdr", ".PNG"}) {
        const fs::path a = folder_ / (std::string("a") + extension),
                       b = folder_ / (std::string("b") + extension);
        write_picture(picture, a, {}, {{"culet:seed", "1"}});
        write_picture(picture, b, {}, {{"culet:seed", "1"}});
        EXPECT_EQ(content(a), content(b)) << extension;
        EXPECT_GT(content(a).size(), 50u);
    }
}

}  // namespace
