// The codecs against those of OpenCV, an independent implementation.

#include "render/image/codecs/codecs.h"

#include <gtest/gtest.h>
#include <png.h>
// jpeglib.h needs this include before it.
#include <cstdio>
// Must follow <cstdio>.
#include <jpeglib.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "stone/text/errors.h"
#include "tests/render/codec_pictures.h"

namespace {

using namespace culet;
using namespace culet::test;

TEST(Codecs, ReadPngsAsOpenCvDoes) {
    for (const auto& [width, height] : k_sizes) {
        for (const int channels : {1, 3, 4}) {
            for (const cv::Mat& image :
                 {random_picture<std::uint8_t>(width, height, channels, 1),
                  random_picture<std::uint16_t>(width, height, channels, 2)}) {
                const std::string bytes = encoded_by_opencv(image, ".png");
                EXPECT_EQ(difference(decode_png(bytes, "a.png"), image), 0)
                    << width << " x " << height << " x " << channels;
            }
        }
        const cv::Mat bits = random_picture<std::uint8_t>(width, height, 1, 3);
        const std::string bytes = encoded_by_opencv(bits, ".png", {cv::IMWRITE_PNG_BILEVEL, 1});
        EXPECT_EQ(difference(decode_png(bytes, "a.png"), decoded_by_opencv(bytes)), 0);
    }
}

TEST(Codecs, WritePngsThatOpenCvReadsToTheLastBit) {
    for (const auto& [width, height] : k_sizes) {
        for (const int channels : {1, 3, 4}) {
            std::vector<std::uint8_t> samples(static_cast<std::size_t>(width * height * channels));
            std::mt19937 random(4);
            for (auto& sample : samples) sample = static_cast<std::uint8_t>(random());
            const std::string bytes = encode_png(width, height, channels, samples,
                                                 {{"culet:a", "1"}, {"culet:b", "\u03bb"}});
            EXPECT_EQ(difference({width, height, channels, samples, {}}, decoded_by_opencv(bytes)),
                      0);
            EXPECT_EQ(encode_png(width, height, channels, samples,
                                 {{"culet:a", "1"}, {"culet:b", "\u03bb"}}),
                      bytes);
        }
    }
}

TEST(Codecs, ReadJpegsAsOpenCvDoes) {
    for (const auto& [width, height] : k_sizes) {
        for (const int channels : {1, 3}) {
            for (const std::vector<int>& options :
                 {std::vector<int>{cv::IMWRITE_JPEG_QUALITY, 90},
                  std::vector<int>{cv::IMWRITE_JPEG_QUALITY, 60, cv::IMWRITE_JPEG_PROGRESSIVE, 1},
                  std::vector<int>{cv::IMWRITE_JPEG_RST_INTERVAL, 1}}) {
                const std::string bytes = encoded_by_opencv(
                    random_picture<std::uint8_t>(width, height, channels, 5), ".jpg", options);
                EXPECT_EQ(difference(decode_jpeg(bytes, "a.jpg"), decoded_by_opencv(bytes)), 0);
            }
        }
    }
}

// An EXIF directory with one entry, orientation, in either byte order.
std::string with_orientation(std::string jpeg, char orientation, bool big_endian) {
    const std::string little("II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0o\0\0\0\0\0\0\0", 26);
    const std::string big("MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0o\0\0\0\0\0\0", 26);
    std::string exif = big_endian ? big : little;
    exif[exif.find('o')] = orientation;
    return jpeg.insert(2, std::string("\xff\xe1\0\x22"
                                      "Exif\0\0",
                                      10) +
                              exif);
}

TEST(Codecs, TurnJpegsAsOpenCvDoes) {
    const std::string stored =
        encoded_by_opencv(random_picture<std::uint8_t>(37, 22, 3, 6), ".jpg");
    for (char orientation = 0; orientation < 11; ++orientation) {
        for (const bool big_endian : {false, true}) {
            const std::string bytes = with_orientation(stored, orientation, big_endian);
            EXPECT_EQ(
                difference(decode_jpeg(bytes, "a.jpg"), decoded_by_opencv(bytes, cv::IMREAD_COLOR)),
                0)
                << int(orientation);
        }
    }
}

TEST(Codecs, ReadRadianceAndFloatMapsAsOpenCvDoes) {
    for (const auto& [width, height] : k_sizes) {
        const cv::Mat colour = random_picture<float>(width, height, 3, 7);
        const std::string hdr = encoded_by_opencv(colour, ".hdr");
        EXPECT_EQ(difference(decode_hdr(hdr, "a.hdr"), decoded_by_opencv(hdr)), 0);
        for (const cv::Mat& image : {colour, random_picture<float>(width, height, 1, 8)}) {
            const std::string pfm = encoded_by_opencv(image, ".pfm");
            EXPECT_EQ(difference(decode_pfm(pfm, "a.pfm"), image), 0);
        }
    }
}

TEST(Codecs, WriteRadianceAndFloatMapsThatOpenCvReads) {
    for (const auto& [width, height] : k_sizes) {
        const cv::Mat image = random_picture<float>(width, height, 3, 9);
        std::vector<float> rgb;
        for (int i = 0; i < width * height; ++i) {
            const auto* pixel = image.ptr<float>() + 3 * i;
            rgb.insert(rgb.end(), {pixel[2], pixel[1], pixel[0]});
        }
        // The same mantissas as OpenCV's.
        const cv::Mat theirs = decoded_by_opencv(encoded_by_opencv(image, ".hdr"));
        const std::string bytes = encode_hdr(width, height, rgb);
        EXPECT_EQ(difference(decode_hdr(bytes, "a.hdr"), theirs), 0);
        EXPECT_EQ(difference(decode_hdr(bytes, "a.hdr"), decoded_by_opencv(bytes)), 0);
        const cv::Mat grey = random_picture<float>(width, height, 1, 10);
        const std::string pfm =
            encode_pfm(width, height, {grey.ptr<float>(), static_cast<std::size_t>(grey.total())});
        EXPECT_EQ(difference(decode_pfm(pfm, "a.pfm"), grey), 0);
        EXPECT_EQ(difference(decode_pfm(pfm, "a.pfm"), decoded_by_opencv(pfm)), 0);
    }
}

// What OpenCV reads but does not write: palettes with transparent colours, grey with alpha,
// seven-pass interlacing, few bits.
std::string png_of_libpng(int colour, int bits, int interlace) {
    const int width = 29, height = 13;
    std::string bytes;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(
        png, &bytes,
        [](png_structp to, png_bytep from, png_size_t count) {
            static_cast<std::string*>(png_get_io_ptr(to))
                ->append(reinterpret_cast<const char*>(from), count);
        },
        nullptr);
    png_set_IHDR(png, info, width, height, bits, colour, interlace, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (colour == PNG_COLOR_TYPE_PALETTE) {
        std::vector<png_color> palette(std::size_t{1} << bits);
        for (std::size_t i = 0; i < palette.size(); ++i) {
            palette[i] = {static_cast<png_byte>(7 * i), static_cast<png_byte>(255 - i),
                          static_cast<png_byte>(i)};
        }
        png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
    }
    const png_byte shares[] = {0, 100};
    if (colour == PNG_COLOR_TYPE_PALETTE) png_set_tRNS(png, info, shares, 2, nullptr);
    png_write_info(png, info);
    std::mt19937 random(21);
    std::vector<png_byte> noise(png_get_rowbytes(png, info) * height);
    for (png_byte& byte : noise) byte = static_cast<png_byte>(random());
    std::vector<png_bytep> rows;
    for (std::size_t y = 0; y < height; ++y)
        rows.push_back(noise.data() + y * png_get_rowbytes(png, info));
    png_write_image(png, rows.data());
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    return bytes;
}

TEST(Codecs, ReadPngsOfEveryKindAsOpenCvDoes) {
    const std::pair<int, int> kinds[] = {
        {PNG_COLOR_TYPE_GRAY, 1},        {PNG_COLOR_TYPE_GRAY, 2},
        {PNG_COLOR_TYPE_GRAY, 4},        {PNG_COLOR_TYPE_GRAY, 8},
        {PNG_COLOR_TYPE_GRAY, 16},       {PNG_COLOR_TYPE_PALETTE, 1},
        {PNG_COLOR_TYPE_PALETTE, 2},     {PNG_COLOR_TYPE_PALETTE, 4},
        {PNG_COLOR_TYPE_PALETTE, 8},     {PNG_COLOR_TYPE_GRAY_ALPHA, 8},
        {PNG_COLOR_TYPE_GRAY_ALPHA, 16}, {PNG_COLOR_TYPE_RGB, 8},
        {PNG_COLOR_TYPE_RGB, 16},        {PNG_COLOR_TYPE_RGB_ALPHA, 8},
        {PNG_COLOR_TYPE_RGB_ALPHA, 16}};
    for (const auto& [colour, bits] : kinds) {
        for (const int interlace : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7}) {
            const std::string bytes = png_of_libpng(colour, bits, interlace);
            EXPECT_EQ(difference(decode_png(bytes, "a.png"), decoded_by_opencv(bytes)), 0)
                << "colour type " << colour << ", " << bits << " bits, interlace " << interlace;
        }
    }
}

// Four inks, as they are and as luminance with colour differences (YCCK).
std::string jpeg_of_inks(J_COLOR_SPACE stored) {
    jpeg_compress_struct info{};
    jpeg_error_mgr errors{};
    info.err = jpeg_std_error(&errors);
    jpeg_create_compress(&info);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&info, &bytes, &size);
    info.image_width = 31;
    info.image_height = 18;
    info.input_components = 4;
    info.in_color_space = JCS_CMYK;
    jpeg_set_defaults(&info);
    jpeg_set_colorspace(&info, stored);
    jpeg_start_compress(&info, TRUE);
    std::vector<JSAMPLE> row(std::size_t{4} * 31);
    std::mt19937 random(22);
    while (info.next_scanline < info.image_height) {
        for (JSAMPLE& sample : row) sample = static_cast<JSAMPLE>(random());
        JSAMPROW first = row.data();
        jpeg_write_scanlines(&info, &first, 1);
    }
    jpeg_finish_compress(&info);
    jpeg_destroy_compress(&info);
    const std::string result(reinterpret_cast<const char*>(bytes), size);
    std::free(bytes);
    return result;
}

// By OpenCV's rule; the decoder returns the inks.
DecodedPixels rgb_of_inks(const DecodedPixels& inks) {
    const auto& from = std::get<std::vector<std::uint8_t>>(inks.samples);
    std::vector<std::uint8_t> rgb;
    for (std::size_t i = 0; i < from.size(); i += 4) {
        const int black = 255 - from[i + 3];
        for (std::size_t c = 0; c < 3; ++c)
            rgb.push_back(static_cast<std::uint8_t>(black - (from[i + c] * black >> 8)));
    }
    return {inks.width, inks.height, 3, std::move(rgb), {}};
}

TEST(Codecs, ReadJpegsOfInksAsOpenCvDoes) {
    for (const J_COLOR_SPACE stored : {JCS_CMYK, JCS_YCCK}) {
        const std::string bytes = jpeg_of_inks(stored);
        EXPECT_EQ(difference(rgb_of_inks(decode_jpeg(bytes, "a.jpg")),
                             decoded_by_opencv(bytes, cv::IMREAD_ANYCOLOR | cv::IMREAD_ANYDEPTH)),
                  0)
            << stored;
    }
}

}  // namespace
