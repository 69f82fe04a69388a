// Files that are truncated, or have a flipped bit.

#include <gtest/gtest.h>
#include <tiffio.h>

#include <cstddef>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <tuple>
#include <variant>

#include "render/image/codecs/codecs.h"
#include "stone/text/errors.h"
#include "tests/render/codec_pictures.h"

namespace {

using namespace culet;
using namespace culet::test;

using Decode = DecodedPixels (*)(const std::string&, const std::filesystem::path&);

// Either the picture is complete, with as many samples as its size says, or the error is one line.
void expect_picture_or_error(Decode decode, const std::string& bytes, const std::string& what) {
    try {
        const DecodedPixels pixels = decode(bytes, "a");
        const std::size_t count =
            std::visit([](const auto& samples) { return samples.size(); }, pixels.samples);
        EXPECT_EQ(count, static_cast<std::size_t>(pixels.width) *
                             static_cast<std::size_t>(pixels.height) *
                             static_cast<std::size_t>(pixels.channels))
            << what;
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << what;
    }
}

TEST(DamagedPictures, AreRefusedWhereCutOffAndSurviveEveryFlippedBit) {
    const cv::Mat small = random_picture<std::uint8_t>(23, 9, 3, 18);
    const cv::Mat floats = random_picture<float>(23, 9, 3, 19);
    const std::tuple<const char*, Decode, std::string> files[] = {
        {"PNG", decode_png, encoded_by_opencv(small, ".png")},
        {"JPEG", decode_jpeg, encoded_by_opencv(small, ".jpg")},
        {"progressive JPEG", decode_jpeg,
         encoded_by_opencv(small, ".jpg", {cv::IMWRITE_JPEG_PROGRESSIVE, 1})},
        {"HDR", decode_hdr, encoded_by_opencv(floats, ".hdr")},
        {"PFM", decode_pfm, encoded_by_opencv(floats, ".pfm")},
        {"TIFF", decode_tiff, written_tiff(23, 9, {}, 20)},
        {"float TIFF", decode_tiff,
         written_tiff(23, 9,
                      {.bits = 32,
                       .format = SAMPLEFORMAT_IEEEFP,
                       .planes = true,
                       .tiles = true,
                       .packing = COMPRESSION_LZW},
                      20)},
    };
    for (const auto& [format, decode, bytes] : files) {
        testing::internal::CaptureStderr();
        const std::string tiff = "TIFF";
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            // A TIFF's directory may follow all pixels, with gaps in it: the loss of its last 8
            // bytes may go unnoticed.
            if (std::string(format).ends_with(tiff) && size + 8 >= bytes.size())
                expect_picture_or_error(decode, bytes.substr(0, size), format);
            else
                EXPECT_THROW(decode(bytes.substr(0, size), "a"), InputError)
                    << format << " cut off behind byte " << size;
        }
        for (std::size_t at = 0; at < bytes.size(); ++at) {
            for (int bit = 0; bit < 8; ++bit) {
                std::string flipped = bytes;
                flipped[at] = static_cast<char>(flipped[at] ^ (1 << bit));
                expect_picture_or_error(decode, flipped, format);
                // A checksum covers every bit of a PNG, or contains it.
                if (decode == decode_png) {
                    EXPECT_THROW(decode(flipped, "a"), InputError) << at;
                }
            }
        }
        EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << format;
    }
}

}  // namespace
