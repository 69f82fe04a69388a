#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <cstring>

#include "render/image/codecs/codecs.h"
#include "stone/errors.h"

namespace culet {

namespace {

// libpng leaves by longjmp, which runs no destructors: functions that call setjmp hold plain
// values only, everything else lives in their callers.
struct PngInput {
    png_structp png = nullptr;
    png_infop info = nullptr;
    const char* next = nullptr;
    std::size_t left = 0;
    bool cut_off = false;
    std::array<char, 160> complaint{};

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

void ignore_png_warning(png_structp, png_const_charp) {}

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

// The header, and what the rows are to be turned into: 8 or 16 bits, no palette, no grey with
// alpha.
bool read_png_head(PngInput& input) {
    png_structp png = input.png;
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_read_fn(png, &input, give_png_bytes);
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // check_size has its own
    png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    png_read_info(png, input.info);
    const png_byte colour = png_get_color_type(png, input.info);
    const bool coloured = (colour & PNG_COLOR_MASK_COLOR) != 0;
    if (std::endian::native == std::endian::little) png_set_swap(png);
    if (colour == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png);
    if (!coloured) png_set_expand_gray_1_2_4_to_8(png);
    if (coloured && png_get_valid(png, input.info, PNG_INFO_tRNS) != 0) png_set_tRNS_to_alpha(png);
    if (colour == PNG_COLOR_TYPE_GRAY_ALPHA) png_set_gray_to_rgb(png);
    png_set_interlace_handling(png);
    png_read_update_info(png, input.info);
    return true;
}

// To the end of the file, whose checksums are looked at on the way.
bool read_png_rows(PngInput& input, png_bytepp rows) {
    if (setjmp(png_jmpbuf(input.png)) != 0) return false;
    png_read_image(input.png, rows);
    png_read_end(input.png, nullptr);
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

}  // namespace

DecodedPixels decode_png(const std::string& bytes, const std::filesystem::path& file) {
    PngInput input;
    input.next = bytes.data();
    input.left = bytes.size();
    input.png =
        png_create_read_struct(PNG_LIBPNG_VER_STRING, &input, leave_png_input, ignore_png_warning);
    check(input.png != nullptr, "libpng starts");
    input.info = png_create_info_struct(input.png);
    check(input.info != nullptr, "libpng has room for a header");
    if (!read_png_head(input)) throw png_refusal(input, file);
    const std::size_t width = png_get_image_width(input.png, input.info),
                      height = png_get_image_height(input.png, input.info),
                      channels = png_get_channels(input.png, input.info);
    check_size(width, height, bytes.size(), "PNG", file);
    DecodedPixels result{
        static_cast<int>(width), static_cast<int>(height), static_cast<int>(channels), {}};
    if (png_get_bit_depth(input.png, input.info) == 16)
        result.samples = png_samples<std::uint16_t>(input, width * channels, height, file);
    else
        result.samples = png_samples<std::uint8_t>(input, width * channels, height, file);
    return result;
}

}  // namespace culet
