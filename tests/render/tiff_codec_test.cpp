// TIFFs of every layout, against OpenCV's decoder and against each other.

#include <gtest/gtest.h>
#include <tiffio.h>

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "render/image/codecs/codecs.h"
#include "render/image/image_io.h"
#include "tests/render/codec_pictures.h"

namespace {

using namespace culet;
using namespace culet::test;

TEST(TiffCodec, ReadsAsOpenCvDoes) {
    for (const auto& [width, height] : k_sizes) {
        for (const int channels : {1, 3, 4}) {
            for (const int packing : {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE,
                                      COMPRESSION_PACKBITS}) {
                for (const cv::Mat& image :
                     {random_picture<std::uint8_t>(width, height, channels, 11),
                      random_picture<std::uint16_t>(width, height, channels, 12),
                      random_picture<float>(width, height, channels, 13),
                      random_picture<double>(width, height, 1, 14)}) {
                    const std::string bytes =
                        encoded_by_opencv(image, ".tiff", {cv::IMWRITE_TIFF_COMPRESSION, packing});
                    EXPECT_EQ(difference(decode_tiff(bytes, "a.tiff"), decoded_by_opencv(bytes)), 0)
                        << width << " x " << height << " x " << channels << " of depth "
                        << image.depth() << ", compression " << packing;
                }
            }
        }
    }
}

double difference_of(const DecodedPixels& a, const DecodedPixels& b) {
    return a.width == b.width && a.height == b.height && a.channels == b.channels &&
                   a.samples == b.samples
               ? 0
               : 1;
}

// For 8 bits with alpha OpenCV returns what libtiff shows: colours times alpha, rounded.
DecodedPixels as_shown(DecodedPixels pixels) {
    auto* const bytes = std::get_if<std::vector<std::uint8_t>>(&pixels.samples);
    if (pixels.channels != 4 || bytes == nullptr) return pixels;
    for (std::size_t i = 0; i < bytes->size(); ++i) {
        std::uint8_t& v = (*bytes)[i];
        if (i % 4 < 3) v = static_cast<std::uint8_t>((v * (*bytes)[i / 4 * 4 + 3] + 127) / 255);
    }
    return pixels;
}

// OpenCV refuses some layouts that it does not write: uncompressed tiles, 16-bit colours in
// separate planes. It reads the same samples packed in whole pixels.
TEST(TiffCodec, ReadsEveryArrangement) {
    const TiffKind kinds[] = {{.bits = 8},
                              {.bits = 16},
                              {.bits = 32, .format = SAMPLEFORMAT_IEEEFP},
                              {.bits = 8, .samples = 1, .colours = PHOTOMETRIC_MINISBLACK},
                              {.bits = 8, .samples = 1, .colours = PHOTOMETRIC_MINISWHITE},
                              {.bits = 16, .samples = 1, .colours = PHOTOMETRIC_MINISBLACK},
                              {.bits = 64,
                               .format = SAMPLEFORMAT_IEEEFP,
                               .samples = 1,
                               .colours = PHOTOMETRIC_MINISBLACK},
                              {.bits = 8, .samples = 1, .colours = PHOTOMETRIC_PALETTE},
                              {.bits = 8, .samples = 4},
                              {.bits = 16, .samples = 4}};
    for (TiffKind kind : kinds) {
        kind.packing = COMPRESSION_LZW;
        const cv::Mat theirs = decoded_by_opencv(written_tiff(45, 37, kind, 15));
        for (const int packing : {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE,
                                  COMPRESSION_LZMA, COMPRESSION_ZSTD}) {
            for (const bool tiles : {false, true}) {
                for (const bool planes : {false, true}) {
                    kind.packing = packing;
                    kind.tiles = tiles;
                    kind.planes = planes;
                    EXPECT_EQ(
                        difference(as_shown(decode_tiff(written_tiff(45, 37, kind, 15), "a.tiff")),
                                   theirs),
                        0)
                        << kind.bits << " bits, " << kind.samples << " samples, tiles " << tiles
                        << ", planes " << planes << ", compression " << packing;
                }
            }
        }
    }
}

TEST(TiffCodec, TurnsAsOpenCvDoes) {
    for (const int bits : {8, 16}) {
        for (int orientation = 1; orientation <= 8; ++orientation) {
            const std::string bytes =
                written_tiff(45, 37, {.bits = bits, .orientation = orientation}, 16);
            EXPECT_EQ(difference(decode_tiff(bytes, "a.tiff"), decoded_by_opencv(bytes)), 0)
                << bits << " bits, orientation " << orientation;
        }
    }
}

// Floating point predictors, and libtiff's logarithms: OpenCV's own choice for floats.
TEST(TiffCodec, ReadsPackedFloats) {
    const TiffKind plain{.bits = 32, .format = SAMPLEFORMAT_IEEEFP};
    TiffKind packed = plain;
    packed.packing = COMPRESSION_ADOBE_DEFLATE;
    packed.predictor = PREDICTOR_FLOATINGPOINT;
    EXPECT_EQ(difference_of(decode_tiff(written_tiff(45, 37, packed, 17), "a.tiff"),
                            decode_tiff(written_tiff(45, 37, plain, 17), "a.tiff")),
              0);
    const cv::Mat image(9, 11, CV_32FC3, cv::Scalar(0.25, 0.5, 0.75));
    const std::string logarithms = encoded_by_opencv(image, ".tiff");
    // Stored as X, Y, Z: the matrix of IEC 61966-2-1 is published with four digits.
    const Picture read = picture_of_bytes(logarithms, "a.tiff").picture;
    EXPECT_LT(difference({read.width, read.height, 3, read.rgb, {}}, decoded_by_opencv(logarithms)),
              5e-4);
}

}  // namespace
