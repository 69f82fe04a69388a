#pragma once
// Pictures for the codecs' tests: noise, OpenCV's versions of it, and TIFFs written by libtiff.

#include <tiffio.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "render/image/codecs/codecs.h"
#include "tests/scratch_folder.h"

namespace culet::test {

// Noise with constant stretches, so that compressors meet runs too. OpenCV's order is blue, green,
// red.
template <class Value>
cv::Mat random_picture(int width, int height, int channels, unsigned seed) {
    cv::Mat image(height, width, CV_MAKETYPE(cv::DataType<Value>::depth, channels));
    std::mt19937 random(seed);
    for (int y = 0; y < height; ++y) {
        Value* row = image.ptr<Value>(y);
        for (int i = 0; i < width * channels; ++i) {
            const bool even = (i / 16 + y / 4) % 2 == 0;
            if constexpr (std::is_integral_v<Value>)
                row[i] = static_cast<Value>(even ? 77 : random());
            else
                row[i] = even ? Value{0.5} : static_cast<Value>(random()) / Value{1e9};
        }
    }
    return image;
}

inline std::string encoded_by_opencv(const cv::Mat& image, const char* extension,
                                     const std::vector<int>& options = {}) {
    std::vector<unsigned char> bytes;
    cv::imencode(extension, image, bytes, options);
    return {bytes.begin(), bytes.end()};
}

inline cv::Mat decoded_by_opencv(const std::string& bytes, int mode = cv::IMREAD_UNCHANGED) {
    return cv::imdecode(std::vector<unsigned char>(bytes.begin(), bytes.end()), mode);
}

// The largest difference of a sample; infinite if the pictures are of different kinds.
inline double difference(const DecodedPixels& ours, const cv::Mat& theirs) {
    constexpr double k_different = std::numeric_limits<double>::infinity();
    if (ours.width != theirs.cols || ours.height != theirs.rows ||
        ours.channels != theirs.channels())
        return k_different;
    return std::visit(
        [&]<class Value>(const std::vector<Value>& samples) {
            const bool doubles = theirs.depth() == CV_64F && std::is_same_v<Value, float>;
            if (theirs.depth() != cv::DataType<Value>::depth && !doubles) return k_different;
            cv::Mat same;
            theirs.convertTo(same, cv::DataType<Value>::depth);
            double most = 0;
            auto sample = samples.begin();
            for (int y = 0; y < same.rows; ++y) {
                for (int x = 0; x < same.cols; ++x) {
                    const Value* pixel = same.ptr<Value>(y) + x * same.channels();
                    for (int c = 0; c < same.channels(); ++c, ++sample) {
                        const Value v = pixel[same.channels() == 1 || c == 3 ? c : 2 - c];
                        most = std::max(most, std::abs(double(v) - double(*sample)));
                    }
                }
            }
            return most;
        },
        ours.samples);
}

inline const std::pair<int, int> k_sizes[] = {{1, 1}, {7, 3}, {33, 21}, {64, 48}, {131, 5}};

struct TiffKind {
    int bits = 8, format = SAMPLEFORMAT_UINT, samples = 3;
    bool planes = false, tiles = false;
    int orientation = ORIENTATION_TOPLEFT, colours = PHOTOMETRIC_RGB;
    int packing = COMPRESSION_NONE, predictor = 0;
};

inline std::string written_tiff(int width, int height, const TiffKind& kind, unsigned seed) {
    const test::ScratchFolder scratch;  // tests run in parallel
    const std::string file = (scratch.path() / "a.tiff").string();
    TIFF* tiff = TIFFOpen(file.c_str(), "w");
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, width);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, height);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, kind.bits);
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, kind.format);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, kind.samples);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, kind.colours);
    TIFFSetField(tiff, TIFFTAG_ORIENTATION, kind.orientation);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, kind.packing);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG,
                 kind.planes ? PLANARCONFIG_SEPARATE : PLANARCONFIG_CONTIG);
    if (kind.predictor != 0) TIFFSetField(tiff, TIFFTAG_PREDICTOR, kind.predictor);
    if (kind.samples == 4 && kind.colours == PHOTOMETRIC_RGB) {
        const std::uint16_t alpha = EXTRASAMPLE_UNASSALPHA;
        TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &alpha);
    }
    if (kind.colours == PHOTOMETRIC_PALETTE) {
        std::vector<std::uint16_t> map(std::size_t{3} << kind.bits);
        for (std::size_t i = 0; i < map.size(); ++i)
            map[i] = static_cast<std::uint16_t>(257 * ((37 * i) % 256));
        const std::size_t third = map.size() / 3;
        TIFFSetField(tiff, TIFFTAG_COLORMAP, &map[0], &map[third], &map[2 * third]);
    }
    if (kind.tiles) {
        TIFFSetField(tiff, TIFFTAG_TILEWIDTH, 32);
        TIFFSetField(tiff, TIFFTAG_TILELENGTH, 16);
    } else {
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 7);
    }
    // Sample (x, y, c) is the same however the file is arranged.
    const auto sample = [&](int x, int y, int c, unsigned char* to) {
        const auto place = static_cast<std::uint32_t>((y * width + x) * 4 + c);
        const std::uint32_t noise = (seed + place) * 2654435761u >> 5;  // Knuth's hash
        if (kind.format == SAMPLEFORMAT_IEEEFP && kind.bits == 32) {
            const float v = static_cast<float>(noise % 1000) / 8;
            std::memcpy(to, &v, sizeof v);
        } else if (kind.format == SAMPLEFORMAT_IEEEFP) {
            const double v = static_cast<double>(noise % 1000) / 8;
            std::memcpy(to, &v, sizeof v);
        } else {
            std::memcpy(to, &noise, static_cast<std::size_t>(std::max(1, kind.bits / 8)));
        }
    };
    const int columns = kind.tiles ? 32 : width, rows = kind.tiles ? 16 : 7;
    const int in_pixel = kind.planes ? 1 : kind.samples;
    const auto bytes = static_cast<std::size_t>(std::max(1, kind.bits / 8));
    for (int plane = 0; plane < (kind.planes ? kind.samples : 1); ++plane) {
        for (int y = 0; y < height; y += rows) {
            for (int x = 0; x < width; x += columns) {
                const int here = kind.tiles ? rows : std::min(rows, height - y);
                std::vector<unsigned char> block(static_cast<std::size_t>(columns * here) *
                                                 static_cast<std::size_t>(in_pixel) * bytes);
                for (int i = 0; i < columns * here * in_pixel; ++i) {
                    const int pixel = i / in_pixel;
                    sample(std::min(x + pixel % columns, width - 1),
                           std::min(y + pixel / columns, height - 1),
                           kind.planes ? plane : i % in_pixel,
                           block.data() + static_cast<std::size_t>(i) * bytes);
                }
                const auto size = static_cast<tmsize_t>(block.size());
                const auto x32 = static_cast<std::uint32_t>(x), y32 = static_cast<std::uint32_t>(y);
                const auto p16 = static_cast<std::uint16_t>(plane);
                if (kind.tiles)
                    TIFFWriteEncodedTile(tiff, TIFFComputeTile(tiff, x32, y32, 0, p16),
                                         block.data(), size);
                else
                    TIFFWriteEncodedStrip(tiff, TIFFComputeStrip(tiff, y32, p16), block.data(),
                                          size);
            }
        }
    }
    TIFFClose(tiff);
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace culet::test
