#include "render/image/image_io.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/image/codecs/codecs.h"
#include "render/image/image_exr.h"
#include "render/image/linear_picture.h"
#include "render/image/picture_format.h"
#include "render/image/shown_bytes.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/text_decoding.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

constexpr std::size_t k_most_bytes = std::size_t{1} << 30;

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
    // The format ends below 2^127; NaN and negative values become 0.
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
    const std::string format = picture_format(bytes);
    if (format == "EXR") return read_exr(bytes, file);
    if (format.empty()) {
        const std::string other = other_picture_format(bytes);
        if (const std::string kind = foreign_kind(bytes); other.empty() && !kind.empty())
            throw InputError(file, kind);
        throw InputError(
            file,
            fmt::format("is {}: EXR, HDR, PFM, PNG, JPEG and TIFF are ({})",
                        other.empty() ? "not a picture that is read"
                                      : "a picture in the format " + other + ", which is not read",
                        other.empty() ? "raw files: convert them to 16-bit TIFF first"
                                      : "convert it to 16-bit TIFF or PNG"));
    }
    return linear_picture(decoded(format, bytes, file), format);
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
