// The codecs against OpenCV's, which read and write the same formats by themselves; files that are
// cut off or have a bit flipped, against the whole ones.

#include "render/image/codecs/codecs.h"

#include <gtest/gtest.h>
#include <tiffio.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "stone/errors.h"
#include "tests/scratch_folder.h"

namespace {

using namespace culet;

// Noise with even parts, so that packers meet runs too; OpenCV's order is blue, green, red.
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

std::string encoded_by_opencv(const cv::Mat& image, const char* extension,
                              const std::vector<int>& options = {}) {
    std::vector<unsigned char> bytes;
    cv::imencode(extension, image, bytes, options);
    return {bytes.begin(), bytes.end()};
}

cv::Mat decoded_by_opencv(const std::string& bytes, int mode = cv::IMREAD_UNCHANGED) {
    return cv::imdecode(std::vector<unsigned char>(bytes.begin(), bytes.end()), mode);
}

// The largest difference of a sample; infinite where the pictures are of different kinds.
double difference(const DecodedPixels& ours, const cv::Mat& theirs) {
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

const std::pair<int, int> k_sizes[] = {{1, 1}, {7, 3}, {33, 21}, {64, 48}, {131, 5}};

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
            EXPECT_EQ(difference({width, height, channels, samples}, decoded_by_opencv(bytes)), 0);
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

// The directory of EXIF with one entry, orientation, in either order of bytes.
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

TEST(Codecs, ReadTiffsAsOpenCvDoes) {
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

struct TiffKind {
    int bits = 8, format = SAMPLEFORMAT_UINT, samples = 3;
    bool planes = false, tiles = false;
    int orientation = ORIENTATION_TOPLEFT, colours = PHOTOMETRIC_RGB;
    int packing = COMPRESSION_NONE, predictor = 0;
};

// A file that libtiff writes, of noise.
std::string written_tiff(int width, int height, const TiffKind& kind, unsigned seed) {
    const test::ScratchFolder scratch;  // tests run beside each other
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
        std::mt19937 random(seed + static_cast<unsigned>((y * width + x) * 4 + c));
        if (kind.format == SAMPLEFORMAT_IEEEFP && kind.bits == 32) {
            const float v = static_cast<float>(random() % 1000) / 8;
            std::memcpy(to, &v, sizeof v);
        } else if (kind.format == SAMPLEFORMAT_IEEEFP) {
            const double v = static_cast<double>(random() % 1000) / 8;
            std::memcpy(to, &v, sizeof v);
        } else {
            const auto v = static_cast<std::uint32_t>(random());
            std::memcpy(to, &v, static_cast<std::size_t>(std::max(1, kind.bits / 8)));
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

double difference_of(const DecodedPixels& a, const DecodedPixels& b) {
    return a.width == b.width && a.height == b.height && a.channels == b.channels &&
                   a.samples == b.samples
               ? 0
               : 1;
}

// OpenCV reads no colour of separate planes in 16 bits or floats: there the same samples in whole
// pixels are the measure.
TEST(Codecs, ReadTiffsOfEveryArrangement) {
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
        for (const bool tiles : {false, true}) {
            for (const int packing : {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE,
                                      COMPRESSION_LZMA, COMPRESSION_ZSTD}) {
                SCOPED_TRACE(std::to_string(kind.bits) + " bits, " + std::to_string(kind.samples) +
                             " samples, tiles " + std::to_string(tiles) + ", compression " +
                             std::to_string(packing));
                // libtiff 4.5 pads these tiles when it writes, and refuses their length when it
                // makes colours of 8 bits of them.
                if (tiles && packing == COMPRESSION_NONE && kind.bits == 8) continue;
                kind.tiles = tiles;
                kind.packing = packing;
                kind.planes = false;
                const std::string bytes = written_tiff(45, 37, kind, 15);
                const DecodedPixels ours = decode_tiff(bytes, "a.tiff");
                EXPECT_EQ(difference(ours, decoded_by_opencv(bytes)), 0);
                kind.planes = true;
                EXPECT_EQ(
                    difference_of(decode_tiff(written_tiff(45, 37, kind, 15), "a.tiff"), ours), 0);
            }
        }
    }
}

TEST(Codecs, TurnTiffsAsOpenCvDoes) {
    for (const int bits : {8, 16}) {
        for (int orientation = 1; orientation <= 8; ++orientation) {
            const std::string bytes =
                written_tiff(45, 37, {.bits = bits, .orientation = orientation}, 16);
            EXPECT_EQ(difference(decode_tiff(bytes, "a.tiff"), decoded_by_opencv(bytes)), 0)
                << bits << " bits, orientation " << orientation;
        }
    }
}

// Floating point predictors, and the library's logarithms: OpenCV's own choice for floats.
TEST(Codecs, ReadPackedFloatTiffs) {
    const TiffKind plain{.bits = 32, .format = SAMPLEFORMAT_IEEEFP};
    TiffKind packed = plain;
    packed.packing = COMPRESSION_ADOBE_DEFLATE;
    packed.predictor = PREDICTOR_FLOATINGPOINT;
    EXPECT_EQ(difference_of(decode_tiff(written_tiff(45, 37, packed, 17), "a.tiff"),
                            decode_tiff(written_tiff(45, 37, plain, 17), "a.tiff")),
              0);
    const cv::Mat image(9, 11, CV_32FC3, cv::Scalar(0.25, 0.5, 0.75));
    const std::string logarithms = encoded_by_opencv(image, ".tiff");
    EXPECT_LT(difference(decode_tiff(logarithms, "a.tiff"), decoded_by_opencv(logarithms)), 1e-5);
}

using Decode = DecodedPixels (*)(const std::string&, const std::filesystem::path&);

// Either the picture is whole, with as many samples as its size says, or the error is one line.
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

TEST(Codecs, RefuseWhatIsCutOffAndSurviveEveryFlippedBit) {
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
            // A TIFF's directory may stand behind all pixels, with gaps in it: less cannot be said.
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
                // Every bit of a PNG is under a checksum, or belongs to one.
                if (decode == decode_png) {
                    EXPECT_THROW(decode(flipped, "a"), InputError) << at;
                }
            }
        }
        EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << format;
    }
}

}  // namespace
