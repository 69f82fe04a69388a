#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <utility>

#include "render/image/codecs/codecs.h"
#include "render/image/codecs/exif.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// libpng exits by longjmp, which runs no destructors, so functions that call setjmp hold plain
// values only; the rest is in their callers.
struct PngInput {
    png_structp png = nullptr;
    png_infop info = nullptr;
    const char* next = nullptr;
    std::size_t left = 0;
    bool cut_off = false;
    std::array<char, 160> complaint{}, warning{};

    PngInput() = default;
    ~PngInput() { png_destroy_read_struct(&png, &info, nullptr); }
    PngInput(const PngInput&) = delete;
    PngInput& operator=(const PngInput&) = delete;
};

[[noreturn]] void leave_png_input(png_structp png, png_const_charp what) {
    auto* input = static_cast<PngInput*>(png_get_error_ptr(png));
    std::snprintf(input->complaint.data(), input->complaint.size(), "%s", what);
    png_longjmp(png, 1);
}

// Keeps warnings about colour chunks that libpng ignores.
void keep_png_warning(png_structp png, png_const_charp what) {
    auto* input = static_cast<PngInput*>(png_get_error_ptr(png));
    const std::string_view text = what;
    const bool of_colours = text.starts_with("iCCP") || text.starts_with("gAMA") ||
                            text.starts_with("cHRM") || text.starts_with("sRGB");
    // libpng recognises some faulty sRGB profiles and treats them as sRGB.
    if (!of_colours || input->warning[0] != '\0' || text.find("sRGB profile") != text.npos) return;
    std::snprintf(input->warning.data(), input->warning.size(), "%s", what);
}

void give_png_bytes(png_structp png, png_bytep to, png_size_t count) {
    auto* input = static_cast<PngInput*>(png_get_io_ptr(png));
    if (count > input->left) {
        input->cut_off = true;
        png_error(png, "the file ends too early");
    }
    std::memcpy(to, input->next, count);
    input->next += count;
    input->left -= count;
}

// Reads the header: all before the pixels.
bool read_png_head(PngInput& input) {
    png_structp png = input.png;
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_read_fn(png, &input, give_png_bytes);
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // check_size has its own limits
    png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    // This libpng does not know the chunk.
    static const png_byte k_cicp[]{'c', 'I', 'C', 'P', 0};
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_ALWAYS, k_cicp, 1);
    png_read_info(png, input.info);
    return true;
}

// Requests rows of 8 or 16 bits without palettes; expands grey with alpha to R, G, B, A.
bool prepare_png_rows(PngInput& input) {
    png_structp png = input.png;
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    const png_byte colour = png_get_color_type(png, input.info);
    const bool transparent = png_get_valid(png, input.info, PNG_INFO_tRNS) != 0;
    if (std::endian::native == std::endian::little) png_set_swap(png);
    if (colour == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png);
    if (colour == PNG_COLOR_TYPE_GRAY) png_set_expand_gray_1_2_4_to_8(png);
    if (transparent) png_set_tRNS_to_alpha(png);
    if (colour == PNG_COLOR_TYPE_GRAY_ALPHA || (colour == PNG_COLOR_TYPE_GRAY && transparent))
        png_set_gray_to_rgb(png);
    png_set_interlace_handling(png);
    png_read_update_info(png, input.info);
    return true;
}

// Reads to the end of the file and checks the checksums.
bool read_png_rows(PngInput& input, png_bytepp rows) {
    if (setjmp(png_jmpbuf(input.png)) != 0) return false;
    png_read_image(input.png, rows);
    png_read_end(input.png, input.info);
    return true;
}

InputError png_refusal(const PngInput& input, const std::filesystem::path& file) {
    const std::string what = input.complaint.data();
    if (input.cut_off) return {file, "is a PNG that is cut off"};
    return {
        file,
        fmt::format("is a damaged or unusual PNG ({}): save it again with another program", what)};
}

template <class Sample>
std::vector<Sample> png_samples(PngInput& input, std::size_t row_samples, std::size_t height,
                                const std::filesystem::path& file) {
    std::vector<Sample> samples(row_samples * height);
    std::vector<png_bytep> rows(height);
    for (std::size_t y = 0; y < height; ++y)
        rows[y] = reinterpret_cast<png_bytep>(samples.data() + y * row_samples);
    if (!read_png_rows(input, rows.data())) throw png_refusal(input, file);
    return samples;
}

// ITU-T H.273, tables 2 and 3, for linear light, powers and sRGB.
SampleMeaning meaning_of_cicp(const png_unknown_chunk& chunk, const std::filesystem::path& file) {
    SampleMeaning meaning;
    if (chunk.size != 4) throw InputError(file, "is a PNG with a damaged cICP chunk");
    const int primaries = chunk.data[0], transfer = chunk.data[1];
    meaning.colours = fmt::format("cICP {}/{}", primaries, transfer);
    if (primaries == 9) meaning.primaries = k_rec2020_primaries;
    if (primaries == 12) meaning.primaries = k_display_p3_primaries;
    if (transfer == 4) meaning.exponent = 2.2;
    if (transfer == 5) meaning.exponent = 2.8;
    if (transfer == 8) meaning.exponent = 1;
    const bool primaries_known = primaries == 1 || primaries == 9 || primaries == 12,
               transfer_known = transfer == 4 || transfer == 5 || transfer == 8 || transfer == 13;
    if (!primaries_known || !transfer_known || chunk.data[2] != 0 || chunk.data[3] != 1) {
        throw InputError(
            file, fmt::format("is a PNG whose cICP chunk names primaries {}, transfer {}, matrix "
                              "{}, range {}, which are not followed here{}: save it as sRGB",
                              primaries, transfer, int(chunk.data[2]), int(chunk.data[3]),
                              transfer == 16   ? " (PQ)"
                              : transfer == 18 ? " (HLG)"
                                               : ""));
    }
    return meaning;
}

// If chunks contradict each other, the first in this order counts (PNG, third edition, 4.3).
SampleMeaning meaning_of_png(const PngInput& input, const std::filesystem::path& file) {
    SampleMeaning meaning;
    png_unknown_chunkp chunks = nullptr;
    const int count = png_get_unknown_chunks(input.png, input.info, &chunks);
    png_charp name = nullptr;
    png_bytep profile = nullptr;
    png_uint_32 length = 0;
    int compression = 0, intent = 0;
    double gamma = 0;
    Primaries xy{};
    if (count > 0) {
        meaning = meaning_of_cicp(chunks[0], file);
    } else if (png_get_iCCP(input.png, input.info, &name, &compression, &profile, &length) != 0) {
        meaning.profile.assign(reinterpret_cast<const char*>(profile), length);
    } else if (png_get_sRGB(input.png, input.info, &intent) == 0) {
        if (png_get_cHRM(input.png, input.info, &xy[3][0], &xy[3][1], &xy[0][0], &xy[0][1],
                         &xy[1][0], &xy[1][1], &xy[2][0], &xy[2][1]) != 0)
            meaning.primaries = xy;
        // Programs write 1/2.2 for sRGB (PNG, 11.3.2.5), and libpng treats values within 5 % as
        // that.
        if (png_get_gAMA(input.png, input.info, &gamma) != 0 && gamma > 0 &&
            std::abs(gamma * 2.2 - 1) > 0.05) {
            meaning.exponent = 1 / gamma;
            meaning.colours = fmt::format("gamma {:.4g}", meaning.exponent);
        }
    }
    if (input.warning[0] != '\0') {
        meaning.notes.push_back(
            fmt::format("what it says of its colours is damaged ({})", input.warning.data()));
    }
    return meaning;
}

// pHYs without a unit gives the pixel's shape: pixels per length across and down.
void add_png_frame(const PngInput& input, SampleMeaning& meaning, int& orientation) {
    png_uint_32 across = 0, down = 0, length = 0;
    int unit = 0;
    if (png_get_pHYs(input.png, input.info, &across, &down, &unit) != 0 && across > 0)
        meaning.pixel_aspect = static_cast<double>(down) / across;
    png_bytep exif = nullptr;
    if (png_get_eXIf_1(input.png, input.info, &length, &exif) != 0)
        orientation = ExifFields({reinterpret_cast<const char*>(exif), length}).orientation();
}

}  // namespace

DecodedPixels decode_png(const std::string& bytes, const std::filesystem::path& file) {
    PngInput input;
    input.next = bytes.data();
    input.left = bytes.size();
    input.png =
        png_create_read_struct(PNG_LIBPNG_VER_STRING, &input, leave_png_input, keep_png_warning);
    check(input.png != nullptr, "libpng starts");
    input.info = png_create_info_struct(input.png);
    check(input.info != nullptr, "libpng has room for a header");
    const bool head = read_png_head(input);
    const std::size_t width = png_get_image_width(input.png, input.info),
                      height = png_get_image_height(input.png, input.info);
    if (head || width > 0) check_size(width, height, bytes.size(), "PNG", file);
    if (!head) throw png_refusal(input, file);
    const bool grey = (png_get_color_type(input.png, input.info) & PNG_COLOR_MASK_COLOR) == 0;
    if (!prepare_png_rows(input)) throw png_refusal(input, file);
    const std::size_t channels = png_get_channels(input.png, input.info);
    DecodedPixels result{static_cast<int>(width),
                         static_cast<int>(height),
                         static_cast<int>(channels),
                         {},
                         meaning_of_png(input, file)};
    result.meaning.grey = channels == 4 && grey;
    if (png_get_bit_depth(input.png, input.info) == 16)
        result.samples = png_samples<std::uint16_t>(input, width * channels, height, file);
    else
        result.samples = png_samples<std::uint8_t>(input, width * channels, height, file);
    int orientation = 1;
    add_png_frame(input, result.meaning, orientation);
    return turned_upright(std::move(result), orientation);
}

}  // namespace culet
