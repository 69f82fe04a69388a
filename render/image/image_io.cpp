#include "render/image/image_io.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>

#include "render/colour/colour.h"
#include "render/image/image_exr.h"
#include "render/image/picture_header.h"
#include "render/image/shown_bytes.h"
#include "stone/errors.h"
#include "stone/output_file.h"

namespace culet {

namespace {

constexpr double k_most_pixels = 268435456.0;  // 2^28
constexpr double k_tightest = 20000;           // pixels a byte, more than any codec packs
constexpr std::size_t k_most_bytes = std::size_t{1} << 30;

// The decoders under OpenCV complain on stderr by themselves; the one line that the user gets is
// ours. Nothing else of culet writes while a picture is read.
class SilentStderr {
public:
    SilentStderr() {
        std::fflush(stderr);
        kept_ = ::dup(STDERR_FILENO);
        const int nowhere = ::open("/dev/null", O_WRONLY);
        if (kept_ >= 0 && nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
        if (nowhere >= 0) ::close(nowhere);
    }
    ~SilentStderr() {
        std::fflush(stderr);
        if (kept_ < 0) return;
        ::dup2(kept_, STDERR_FILENO);
        ::close(kept_);
    }
    SilentStderr(const SilentStderr&) = delete;
    SilentStderr& operator=(const SilentStderr&) = delete;

private:
    int kept_ = -1;
};

void silence_opencv() {
    static const auto once = cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    (void)once;
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

// PNG specification, annex D.
std::uint32_t crc32(const char* bytes, std::size_t size) {
    static const std::array<std::uint32_t, 256> table = [] {
        std::array<std::uint32_t, 256> result{};
        for (std::uint32_t i = 0; i < 256; ++i) {
            result[i] = i;
            for (int bit = 0; bit < 8; ++bit)
                result[i] = result[i] >> 1 ^ (result[i] & 1 ? 0xedb88320u : 0);
        }
        return result;
    }();
    std::uint32_t crc = 0xffffffffu;
    for (std::size_t i = 0; i < size; ++i)
        crc = crc >> 8 ^ table[(crc ^ static_cast<unsigned char>(bytes[i])) & 0xff];
    return ~crc;
}

// The decoders below show as much as there is of a file that was cut off, grey for the rest, and
// complain on stderr. A photograph that is half there is no measurement: it is refused.
void require_whole_png(const std::string& bytes, const std::filesystem::path& file) {
    std::size_t at = 8;
    while (bytes.size() - at >= 12) {
        const std::size_t size = big_endian(bytes, at);
        if (size > bytes.size() - at - 12) break;
        if (crc32(bytes.data() + at + 4, size + 4) != big_endian(bytes, at + 8 + size))
            throw InputError(file, "is a PNG with a damaged part (its checksum is wrong)");
        if (bytes.compare(at + 4, 4, "IEND") == 0) return;
        at += 12 + size;
    }
    throw InputError(file, "is a PNG that is cut off");
}

// ITU-T T.81, B.1.1: segments with a length (a thumbnail lies inside one), and after each start of
// scan, coded data up to the next marker. Ends with the marker EOI.
void require_whole_jpeg(const std::string& bytes, const std::filesystem::path& file) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
    std::size_t at = 2;
    while (at + 1 < bytes.size()) {
        const int marker = byte(at + 1);
        const bool coded = byte(at) != 0xff || marker == 0x00 || marker == 0xff;
        const bool alone = marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8);
        if (coded) {
            ++at;
        } else if (marker == 0xd9) {
            return;
        } else if (alone) {
            at += 2;
        } else if (at + 3 < bytes.size()) {
            at += 2 + static_cast<std::size_t>(byte(at + 2) << 8 | byte(at + 3));
        } else {
            break;
        }
    }
    throw InputError(file, "is a JPEG that is cut off");
}

// A hostile header must not make the decoder take gigabytes for a file of a few bytes.
void check_size(const PictureHeader& header, std::size_t bytes, const std::filesystem::path& file) {
    const double pixels = static_cast<double>(header.width) * static_cast<double>(header.height);
    if (pixels > k_most_pixels) {
        throw InputError(file, fmt::format("is a {} of {} x {} pixels; up to 2^28 pixels are read",
                                           header.format, header.width, header.height));
    }
    if (pixels == 0) {
        throw InputError(file, fmt::format("is a {} that does not state its size: it is cut off "
                                           "or of an unusual kind",
                                           header.format));
    }
    if (pixels / k_tightest > static_cast<double>(bytes)) {
        throw InputError(file, fmt::format("is a {} of {} x {} pixels in {} bytes: it is cut off",
                                           header.format, header.width, header.height, bytes));
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

std::string be32(std::uint32_t value) {
    return {static_cast<char>(value >> 24), static_cast<char>(value >> 16),
            static_cast<char>(value >> 8), static_cast<char>(value)};
}

// PNG specification 11.3.4.3 and 11.3.4.5: keyword, zero, text in Latin-1; or, for text beyond
// ASCII, without compression, language and translated keyword, in UTF-8. OpenCV writes none.
std::string text_chunk(const std::string& key, const std::string& value) {
    const bool ascii = std::all_of(value.begin(), value.end(),
                                   [](char c) { return static_cast<unsigned char>(c) < 128; });
    const std::string body =
        (ascii ? "tEXt" : "iTXt") + key.substr(0, 79) + std::string(ascii ? 1 : 5, '\0') + value;
    return be32(static_cast<std::uint32_t>(body.size() - 4)) + body +
           be32(crc32(body.data(), body.size()));
}

std::string hdr_bytes(const Picture& picture) {
    cv::Mat image(picture.height, picture.width, CV_32FC3);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const float* rgb = picture.at(x, y);
            // The format's shared exponent ends below 2^127; NaN and negative become 0.
            for (int c = 0; c < 3; ++c)
                image.at<cv::Vec3f>(y, x)[2 - c] = std::min(std::max(0.0f, rgb[c]), 1.6e38f);
        }
    }
    std::vector<unsigned char> encoded;
    cv::imencode(".hdr", image, encoded);
    return {encoded.begin(), encoded.end()};
}

}  // namespace

std::string png_of(const Picture& picture, const PngLook& look,
                   std::vector<std::pair<std::string, std::string>> text) {
    const bool alpha = look.alpha && !picture.coverage.empty();
    std::vector<unsigned char> values = shown_bytes(picture, look, alpha);
    // OpenCV's order is blue, green, red.
    const std::size_t channels = alpha ? 4 : 3;
    for (std::size_t i = 0; i < picture.pixels(); ++i)
        std::swap(values[channels * i], values[channels * i + 2]);
    const cv::Mat image(picture.height, picture.width, alpha ? CV_8UC4 : CV_8UC3, values.data());
    std::vector<unsigned char> encoded;
    cv::imencode(".png", image, encoded);
    std::string bytes(encoded.begin(), encoded.end());
    text.insert(text.begin(), {{"culet:exposure", fmt::format("{}", look.exposure)},
                               {"culet:tonemap", name_of(look.tone_map)}});
    if (look.glare > 0) text.emplace_back("culet:glare", fmt::format("{}", look.glare));
    if (look.sparkle > 0) text.emplace_back("culet:sparkle", fmt::format("{}", look.sparkle));
    std::string chunks;
    for (const auto& [key, value] : text) chunks += text_chunk(key, value);
    return bytes.insert(33, chunks);  // behind the signature (8) and the header chunk (25)
}

ReadPicture read_picture(const std::filesystem::path& file) {
    return picture_of_bytes(read_text(file, k_most_bytes), file);
}

ReadPicture picture_of_bytes(const std::string& bytes, const std::filesystem::path& file) {
    silence_opencv();
    if (bytes.empty()) throw InputError(file, "is empty: expected a picture");
    ReadPicture result;
    const PictureHeader header = picture_header(bytes);
    if (header.format == "EXR") {
        result.picture = read_exr(bytes, file, result.had_alpha);
        result.encoding = "linear EXR";
        return result;
    }
    if (header.format.empty()) {
        throw InputError(
            file,
            "is no picture that can be read here: EXR, HDR, PFM, PNG, JPEG and TIFF are (raw "
            "files: convert them to 16-bit TIFF first)");
    }
    check_size(header, bytes.size(), file);
    if (header.format == "PNG") require_whole_png(bytes, file);
    if (header.format == "JPEG") require_whole_jpeg(bytes, file);
    // As it is stored, with alpha; only a JPEG is also turned upright as its EXIF tag says.
    const int mode =
        header.format == "JPEG" ? cv::IMREAD_ANYCOLOR | cv::IMREAD_ANYDEPTH : cv::IMREAD_UNCHANGED;
    cv::Mat image;
    try {
        const cv::Mat data(1, static_cast<int>(bytes.size()), CV_8U,
                           const_cast<char*>(bytes.data()));
        const SilentStderr silent;
        image = cv::imdecode(data, mode);
    } catch (const std::exception&) {
        image.release();
    }
    if (image.empty())
        throw InputError(file, fmt::format("is a broken or unusual {}: save it again with another "
                                           "program",
                                           header.format));
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
    result.encoding = image.depth() == CV_8U    ? "8-bit sRGB"
                      : image.depth() == CV_16U ? "16-bit sRGB"
                                                : "linear " + header.format;
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
    const std::size_t pixels = picture.pixels();
    check(picture.width > 0 && picture.height > 0 && picture.rgb.size() == 3 * pixels &&
              (picture.coverage.empty() || picture.coverage.size() == pixels) &&
              picture.spectral.size() == picture.wavelengths_nm.size(),
          "a picture to be written has all its pixels");
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".exr") {
        OutputFile output(file);
        write_exr(picture, output.path(), text);
        output.commit();
    } else if (extension == ".png") {
        write_text(file, png_of(picture, look, text));
    } else if (extension == ".hdr") {
        write_text(file, hdr_bytes(picture));
    } else {
        throw InputError(file, "pictures are written as .exr, .png or .hdr");
    }
}

}  // namespace culet
