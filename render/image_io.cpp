#include "render/image_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>

#include "render/colour.h"
#include "render/image_exr.h"
#include "stone/errors.h"
#include "stone/output_file.h"

namespace culet {

namespace {

constexpr double k_most_pixels = 268435456.0;  // 2^28
constexpr std::size_t k_most_bytes = std::size_t{2} << 30;

void silence_opencv() {
    static const auto once = cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    (void)once;
}

bool starts_with(const std::string& bytes, const char* magic, std::size_t size) {
    return bytes.size() >= size && std::memcmp(bytes.data(), magic, size) == 0;
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

// A PNG's size stands in its first chunk: an absurd one is refused before anything is allocated.
void check_png_size(const std::string& bytes, const std::filesystem::path& file) {
    if (bytes.size() < 24) throw InputError(file, "is a PNG that is cut off");
    const double width = big_endian(bytes, 16), height = big_endian(bytes, 20);
    if (width * height > k_most_pixels) {
        throw InputError(
            file, fmt::format("is a PNG of {:.0f} x {:.0f} pixels; up to 2^28 pixels are read",
                              width, height));
    }
}

template <class Value>
void take_pixels(const cv::Mat& image, Picture& picture, double scale, bool encoded) {
    const int channels = image.channels();
    std::vector<float> decoded;
    if (encoded) {
        // One table for all values of an integer file.
        decoded.resize(static_cast<std::size_t>(std::lround(scale)) + 1);
        for (std::size_t v = 0; v < decoded.size(); ++v) {
            decoded[v] = static_cast<float>(srgb_decoded(static_cast<double>(v) / scale));
        }
    }
    const auto linear = [&](Value v) {
        if constexpr (std::is_integral_v<Value>)
            return decoded[v];
        else
            return static_cast<float>(v);
    };
    for (int y = 0; y < image.rows; ++y) {
        const Value* row = image.ptr<Value>(y);
        for (int x = 0; x < image.cols; ++x) {
            const std::size_t pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(image.cols) +
                static_cast<std::size_t>(x);
            const Value* v = row + channels * x;
            for (int c = 0; c < 3; ++c)
                picture.rgb[3 * pixel + static_cast<std::size_t>(c)] =
                    linear(channels < 3 ? v[0] : v[2 - c]);
            if (channels == 4)
                picture.coverage[pixel] = static_cast<float>(static_cast<double>(v[3]) / scale);
        }
    }
}

std::uint32_t crc32(const std::string& bytes) {
    std::uint32_t crc = 0xffffffffu;
    for (unsigned char byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    }
    return ~crc;
}

std::string be32(std::uint32_t value) {
    return {static_cast<char>(value >> 24), static_cast<char>(value >> 16),
            static_cast<char>(value >> 8), static_cast<char>(value)};
}

// PNG specification 11.3.4.3: keyword, zero, Latin-1 text. OpenCV writes none.
std::string text_chunk(const std::string& key, const std::string& value) {
    const std::string body = "tEXt" + key.substr(0, 79) + std::string(1, '\0') + value;
    return be32(static_cast<std::uint32_t>(body.size() - 4)) + body + be32(crc32(body));
}

std::string png_bytes(const Picture& picture, const PngLook& look,
                      std::vector<std::pair<std::string, std::string>> text) {
    cv::Mat image(picture.height, picture.width, CV_8UC3);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const float* rgb = picture.at(x, y);
            for (int c = 0; c < 3; ++c) {
                double v = std::max(0.0, look.exposure * static_cast<double>(rgb[c]));
                if (look.tone_map == ToneMap::reinhard)
                    v = v / (1 + v);  // Reinhard et al. 2002, eq. 3
                const double encoded = srgb_encoded(std::min(v, 1.0));
                image.at<cv::Vec3b>(y, x)[2 - c] =
                    static_cast<unsigned char>(std::lround(255 * encoded));
            }
        }
    }
    std::vector<unsigned char> encoded;
    cv::imencode(".png", image, encoded);
    std::string bytes(encoded.begin(), encoded.end());
    text.insert(text.begin(),
                {{"culet:exposure", fmt::format("{}", look.exposure)},
                 {"culet:tonemap", look.tone_map == ToneMap::reinhard ? "reinhard" : "none"}});
    std::string chunks;
    for (const auto& [key, value] : text) chunks += text_chunk(key, value);
    return bytes.insert(33, chunks);  // behind the signature (8) and the header chunk (25)
}

std::string hdr_bytes(const Picture& picture) {
    cv::Mat image(picture.height, picture.width, CV_32FC3);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const float* rgb = picture.at(x, y);
            for (int c = 0; c < 3; ++c) image.at<cv::Vec3f>(y, x)[2 - c] = std::max(0.0f, rgb[c]);
        }
    }
    std::vector<unsigned char> encoded;
    cv::imencode(".hdr", image, encoded);
    return {encoded.begin(), encoded.end()};
}

}  // namespace

ReadPicture read_picture(const std::filesystem::path& file) {
    silence_opencv();
    const std::string bytes = read_text(file, k_most_bytes);
    if (bytes.empty()) throw InputError(file, "is empty: expected a picture");
    ReadPicture result;
    if (starts_with(bytes, "\x76\x2f\x31\x01", 4)) {
        result.picture = read_exr(bytes, file, result.had_alpha);
        return result;
    }
    if (starts_with(bytes, "\x89PNG\r\n\x1a\n", 8)) check_png_size(bytes, file);
    cv::Mat image;
    try {
        const cv::Mat data(1, static_cast<int>(std::min<std::size_t>(bytes.size(), 0x7fffffff)),
                           CV_8U, const_cast<char*>(bytes.data()));
        image = cv::imdecode(data, cv::IMREAD_UNCHANGED);
    } catch (const std::exception&) {
        image.release();
    }
    if (image.empty())
        throw InputError(file,
                         "is no picture that can be read: expected EXR, HDR, PNG, JPEG or TIFF");
    if (static_cast<double>(image.rows) * image.cols > k_most_pixels) {
        throw InputError(file, fmt::format("is {} x {} pixels; up to 2^28 pixels are read",
                                           image.cols, image.rows));
    }
    if (image.channels() == 2 || image.channels() > 4) {
        throw InputError(
            file, fmt::format("has {} channels; expected grey, RGB or RGBA", image.channels()));
    }
    result.picture.width = image.cols;
    result.picture.height = image.rows;
    result.picture.rgb.resize(3 * result.picture.pixels());
    result.had_alpha = image.channels() == 4;
    if (result.had_alpha) result.picture.coverage.resize(result.picture.pixels());
    result.was_encoded = image.depth() == CV_8U || image.depth() == CV_16U;
    result.white = result.was_encoded ? 1.0f : 0.0f;
    switch (image.depth()) {
        case CV_8U:
            take_pixels<unsigned char>(image, result.picture, 255, true);
            break;
        case CV_16U:
            take_pixels<unsigned short>(image, result.picture, 65535, true);
            break;
        case CV_32F:
            take_pixels<float>(image, result.picture, 1, false);
            break;
        case CV_64F:
            take_pixels<double>(image, result.picture, 1, false);
            break;
        default:
            throw InputError(
                file, "has a pixel type that is not read here; expected 8 bit, 16 bit or float");
    }
    return result;
}

void write_picture(const Picture& picture, const std::filesystem::path& file, const PngLook& look,
                   const std::vector<std::pair<std::string, std::string>>& text) {
    silence_opencv();
    const std::string extension = file.extension().string();
    if (extension == ".exr") {
        OutputFile output(file);
        write_exr(picture, output.path(), text);
        output.commit();
    } else if (extension == ".png") {
        write_text(file, png_bytes(picture, look, text));
    } else if (extension == ".hdr") {
        write_text(file, hdr_bytes(picture));
    } else {
        throw InputError(file, "pictures are written as .exr, .png or .hdr");
    }
}

}  // namespace culet
