#include "render/image/image_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <variant>

#include "render/colour/colour.h"
#include "render/image/codecs/codecs.h"
#include "render/image/image_exr.h"
#include "render/image/picture_header.h"
#include "render/image/shown_bytes.h"
#include "stone/errors.h"
#include "stone/file_kind.h"
#include "stone/output_file.h"
#include "stone/text_decoding.h"

namespace culet {

namespace {

constexpr std::size_t k_most_bytes = std::size_t{1} << 30;

// The linear value of each value of an integer file, and of a float itself.
template <class Value>
class Linear {
public:
    Linear() {
        if constexpr (std::is_integral_v<Value>) {
            table_.resize(std::size_t{std::numeric_limits<Value>::max()} + 1);
            for (std::size_t v = 0; v < table_.size(); ++v)
                table_[v] = static_cast<float>(srgb_decoded(static_cast<double>(v) / k_white));
        }
    }
    float operator()(Value value) const {
        if constexpr (std::is_integral_v<Value>)
            return table_[value];
        else
            return value;
    }
    static float coverage(Value value) {
        return static_cast<float>(static_cast<double>(value) / k_white);
    }

private:
    static constexpr double k_white =
        std::is_integral_v<Value> ? static_cast<double>(std::numeric_limits<Value>::max()) : 1;
    std::vector<float> table_;
};

template <class Value>
void take_pixels(const std::vector<Value>& samples, std::size_t channels, Picture& picture) {
    const Linear<Value> linear;
    const Value* v = samples.data();
    for (std::size_t pixel = 0; pixel < picture.pixels(); ++pixel, v += channels) {
        for (std::size_t c = 0; c < 3; ++c)
            picture.rgb[3 * pixel + c] = linear(channels < 3 ? v[0] : v[c]);
        if (channels == 4) picture.coverage[pixel] = linear.coverage(v[3]);
    }
}

DecodedPixels decoded(const std::string& format, const std::string& bytes,
                      const std::filesystem::path& file) {
    if (format == "PNG") return decode_png(bytes, file);
    if (format == "JPEG") return decode_jpeg(bytes, file);
    if (format == "TIFF") return decode_tiff(bytes, file);
    if (format == "HDR") return decode_hdr(bytes, file);
    return decode_pfm(bytes, file);
}

std::string hdr_of(const Picture& picture) {
    std::vector<float> rgb(picture.rgb.size());
    // The format's shared exponent ends below 2^127; NaN and negative become 0.
    std::transform(picture.rgb.begin(), picture.rgb.end(), rgb.begin(),
                   [](float v) { return std::min(std::max(0.0f, v), 1.6e38f); });
    return encode_hdr(picture.width, picture.height, rgb);
}

}  // namespace

std::string png_of(const Picture& picture, const PngLook& look,
                   std::vector<std::pair<std::string, std::string>> text) {
    const bool alpha = look.alpha && !picture.coverage.empty();
    text.insert(text.begin(), {{"culet:exposure", fmt::format("{}", look.exposure)},
                               {"culet:tonemap", name_of(look.tone_map)}});
    if (look.glare > 0) text.emplace_back("culet:glare", fmt::format("{}", look.glare));
    if (look.sparkle > 0) text.emplace_back("culet:sparkle", fmt::format("{}", look.sparkle));
    return encode_png(picture.width, picture.height, alpha ? 4 : 3,
                      shown_bytes(picture, look, alpha), text);
}

ReadPicture read_picture(const std::filesystem::path& file) {
    return picture_of_bytes(read_text(file, k_most_bytes), file);
}

ReadPicture picture_of_bytes(const std::string& bytes, const std::filesystem::path& file) {
    if (bytes.empty()) throw InputError(file, "is empty: expected a picture");
    ReadPicture result;
    const PictureHeader header = picture_header(bytes);
    if (header.format == "EXR") {
        result.picture = read_exr(bytes, file, result.had_alpha);
        result.encoding = "linear EXR";
        return result;
    }
    if (header.format.empty()) {
        if (const std::string other = foreign_kind(bytes); !other.empty())
            throw InputError(file, other);
        throw InputError(
            file,
            "is no picture that can be read here: EXR, HDR, PFM, PNG, JPEG and TIFF are (raw "
            "files: convert them to 16-bit TIFF first)");
    }
    check_size(header.width, header.height, bytes.size(), header.format.c_str(), file);
    const DecodedPixels pixels = decoded(header.format, bytes, file);
    result.picture.width = pixels.width;
    result.picture.height = pixels.height;
    result.picture.rgb.resize(3 * result.picture.pixels());
    result.had_alpha = pixels.channels == 4;
    if (result.had_alpha) result.picture.coverage.resize(result.picture.pixels());
    result.was_encoded = !std::holds_alternative<std::vector<float>>(pixels.samples);
    result.white = result.was_encoded ? 1.0f : 0.0f;
    result.encoding = std::holds_alternative<std::vector<std::uint8_t>>(pixels.samples)
                          ? "8-bit sRGB"
                      : std::holds_alternative<std::vector<std::uint16_t>>(pixels.samples)
                          ? "16-bit sRGB"
                          : "linear " + header.format;
    std::visit(
        [&](const auto& samples) {
            take_pixels(samples, static_cast<std::size_t>(pixels.channels), result.picture);
        },
        pixels.samples);
    return result;
}

void write_picture(const Picture& picture, const std::filesystem::path& file, const PngLook& look,
                   const std::vector<std::pair<std::string, std::string>>& text) {
    const std::size_t pixels = picture.pixels();
    check(picture.width > 0 && picture.height > 0 && picture.rgb.size() == 3 * pixels &&
              (picture.coverage.empty() || picture.coverage.size() == pixels) &&
              picture.spectral.size() == picture.wavelengths_nm.size(),
          "a picture to be written has all its pixels");
    const std::string extension = extension_of(file);
    if (extension == "exr") {
        OutputFile output(file);
        write_exr(picture, output.path(), text);
        output.commit();
    } else if (extension == "png") {
        write_text(file, png_of(picture, look, text));
    } else if (extension == "hdr") {
        write_text(file, hdr_of(picture));
    } else {
        throw InputError(file, "pictures are written as .exr, .png or .hdr");
    }
}

}  // namespace culet
