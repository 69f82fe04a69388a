#include "compare/photo.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "render/picture_header.h"
#include "render/colour.h"
#include "stone/errors.h"
#include "stone/output_file.h"

namespace culet {

namespace {

constexpr std::size_t k_max_file_bytes = std::size_t{1} << 30;

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

struct Decoded {
    cv::Mat pixels;
    std::string format;
};

Decoded decode(const std::filesystem::path& file) {
    const std::string bytes = read_text(file, k_max_file_bytes);
    if (bytes.empty()) throw InputError(file, "is empty");
    const PictureHeader header = picture_header(bytes);
    if (header.format.empty()) {
        throw InputError(file,
                         "is no picture that can be read here: PNG, JPEG, TIFF, EXR, HDR "
                         "and PFM are (raw files: convert them to 16-bit TIFF first)");
    }
    if (static_cast<double>(header.width) * static_cast<double>(header.height) >
        k_max_photo_pixels) {
        throw InputError(file,
                         fmt::format("says it has {} x {} pixels; up to {:.0f} million are read",
                                     header.width, header.height, k_max_photo_pixels / 1e6));
    }
    // IMREAD_COLOR turns a JPEG upright by its EXIF tag; IMREAD_UNCHANGED keeps alpha and floats.
    const int mode =
        header.format == "JPEG" ? cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH : cv::IMREAD_UNCHANGED;
    const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
    cv::Mat pixels;
    try {
        const SilentStderr silent;
        pixels = cv::imdecode(buffer, mode);
    } catch (const cv::Exception& error) {
        throw InputError(file, fmt::format("is a broken {} file ({})", header.format, error.err));
    }
    if (pixels.empty()) {
        throw InputError(file, fmt::format("is a broken or unusual {} file: save it again with "
                                           "another program",
                                           header.format));
    }
    if (static_cast<double>(pixels.total()) > k_max_photo_pixels) {
        throw InputError(file, "has too many pixels");
    }
    return {pixels, header.format};
}

std::array<float, 65536> decoding_table(double top) {
    std::array<float, 65536> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        table[i] = static_cast<float>(srgb_decoded(std::min(1.0, static_cast<double>(i) / top)));
    }
    return table;
}

template <class Sample, class Decode>
void unpack(const cv::Mat& pixels, const Decode& linear, double alpha_top, Photo& photo) {
    const int channels = pixels.channels();
    const bool has_alpha = channels == 2 || channels == 4;
    const std::size_t count = pixels.total();
    photo.rgb.resize(3 * count);
    if (has_alpha) photo.coverage.resize(count);
    std::size_t at = 0;
    for (int y = 0; y < pixels.rows; ++y) {
        const Sample* p = pixels.ptr<Sample>(y);
        for (int x = 0; x < pixels.cols; ++x, p += channels, ++at) {
            // OpenCV stores blue first.
            const bool grey = channels < 3;
            photo.rgb[3 * at + 0] = linear(p[grey ? 0 : 2]);
            photo.rgb[3 * at + 1] = linear(p[grey ? 0 : 1]);
            photo.rgb[3 * at + 2] = linear(p[0]);
            if (has_alpha) {
                photo.coverage[at] = static_cast<float>(
                    std::clamp(static_cast<double>(p[channels - 1]) / alpha_top, 0.0, 1.0));
            }
        }
    }
}

void unpack_integers(const cv::Mat& pixels, Photo& photo) {
    const bool deep = pixels.depth() == CV_16U;
    const double top = deep ? 65535.0 : 255.0;
    const auto table = std::make_unique<std::array<float, 65536>>(decoding_table(top));
    const auto linear = [&](unsigned value) { return (*table)[value]; };
    if (deep) {
        unpack<std::uint16_t>(pixels, linear, top, photo);
    } else {
        unpack<std::uint8_t>(pixels, linear, top, photo);
    }
    photo.saturation = 1;
    photo.encoding = deep ? "16-bit sRGB" : "8-bit sRGB";
}

void unpack_floats(const cv::Mat& pixels, const std::string& format, Photo& photo) {
    std::size_t not_finite = 0, negative = 0;
    const auto linear = [&](float value) {
        if (!std::isfinite(value)) {
            ++not_finite;
            return 0.0f;
        }
        if (value < 0) {
            ++negative;
            return 0.0f;
        }
        return value;
    };
    cv::Mat floats;
    pixels.convertTo(floats, CV_32F);
    unpack<float>(floats, linear, 1.0, photo);
    for (float& c : photo.coverage) {
        if (!std::isfinite(c)) c = 0;
    }
    if (not_finite > 0) {
        photo.notes.push_back(
            fmt::format("{} samples were no finite numbers and count as 0", not_finite));
    }
    if (negative > 0)
        photo.notes.push_back(fmt::format("{} negative samples count as 0", negative));
    photo.encoding = "linear " + format;
}

}  // namespace

Photo read_photo(const std::filesystem::path& file) {
    const Decoded decoded = decode(file);
    Photo photo;
    photo.width = decoded.pixels.cols;
    photo.height = decoded.pixels.rows;
    switch (decoded.pixels.depth()) {
        case CV_8U:
        case CV_16U:
            unpack_integers(decoded.pixels, photo);
            break;
        case CV_32F:
        case CV_64F:
            unpack_floats(decoded.pixels, decoded.format, photo);
            break;
        default:
            throw InputError(file, "has signed integers as samples: save it as 8 or 16 bit");
    }
    return photo;
}

std::vector<float> read_mask(const std::filesystem::path& file, int width, int height) {
    const Photo mask = read_photo(file);
    if (mask.width != width || mask.height != height) {
        throw InputError(file, fmt::format("is a mask of {} x {} pixels for a photograph of {} x "
                                           "{}: they must be of one size",
                                           mask.width, mask.height, width, height));
    }
    std::vector<float> stone(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const float half = static_cast<float>(mask.saturation > 0 ? srgb_decoded(0.5) : 0.5);
    for (std::size_t i = 0; i < stone.size(); ++i) {
        const float brightest =
            std::max({mask.rgb[3 * i], mask.rgb[3 * i + 1], mask.rgb[3 * i + 2]});
        const bool opaque = mask.coverage.empty() || mask.coverage[i] > 0.5f;
        stone[i] = opaque && brightest > half ? 1.0f : 0.0f;
    }
    return stone;
}

}  // namespace culet
