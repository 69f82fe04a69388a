#include <fmt/format.h>
// jpeglib.h needs these before it.
#include <csetjmp>
#include <cstddef>
#include <cstdio>
// After them.
#include <jpeglib.h>
// After it.
#include <jerror.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "render/image/codecs/codecs.h"
#include "stone/errors.h"

namespace culet {

namespace {

// libjpeg leaves by longjmp, which runs no destructors: functions that call setjmp hold plain
// values only, everything else lives in their callers.
struct JpegInput {
    jpeg_decompress_struct info{};
    jpeg_error_mgr errors{};
    std::jmp_buf leave{};
    bool cut_off = false;
    std::array<char, JMSG_LENGTH_MAX> complaint{};

    JpegInput() = default;
    ~JpegInput() { jpeg_destroy_decompress(&info); }
    JpegInput(const JpegInput&) = delete;
    JpegInput& operator=(const JpegInput&) = delete;
};

[[noreturn]] void leave_jpeg(j_common_ptr info) {
    auto* input = static_cast<JpegInput*>(info->client_data);
    input->cut_off = info->err->msg_code == JWRN_JPEG_EOF;
    info->err->format_message(info, input->complaint.data());
    std::longjmp(input->leave, 1);
}

// libjpeg goes on after damage and fills in grey. A photograph that is half there is no
// measurement: it is refused. Of the other warnings, cameras' files cause some (bytes between
// segments), and nothing is missing.
void judge_jpeg_warning(j_common_ptr info, int level) {
    if (level >= 0) return;
    switch (info->err->msg_code) {
        case JWRN_JPEG_EOF:
        case JWRN_HIT_MARKER:
        case JWRN_HUFF_BAD_CODE:
        case JWRN_ARITH_BAD_CODE:
        case JWRN_MUST_RESYNC:
        case JWRN_BOGUS_PROGRESSION:
            leave_jpeg(info);
        default:
            break;
    }
}

void say_nothing(j_common_ptr) {}

bool read_jpeg_head(JpegInput& input, const std::string& bytes) {
    if (setjmp(input.leave) != 0) return false;
    jpeg_create_decompress(&input.info);
    input.info.client_data = &input;
    jpeg_mem_src(&input.info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_save_markers(&input.info, JPEG_APP0 + 1, 0xffff);
    jpeg_read_header(&input.info, TRUE);
    return true;
}

// To the end of the file.
bool read_jpeg_rows(JpegInput& input, JSAMPROW first, std::size_t row_bytes) {
    if (setjmp(input.leave) != 0) return false;
    const int components = input.info.num_components;
    input.info.out_color_space = components == 1   ? JCS_GRAYSCALE
                                 : components == 3 ? JCS_RGB
                                                   : JCS_CMYK;
    jpeg_start_decompress(&input.info);
    while (input.info.output_scanline < input.info.output_height) {
        JSAMPROW row = first + input.info.output_scanline * row_bytes;
        jpeg_read_scanlines(&input.info, &row, 1);
    }
    jpeg_finish_decompress(&input.info);
    return true;
}

InputError jpeg_refusal(const JpegInput& input, const std::filesystem::path& file) {
    if (input.cut_off) return {file, "is a JPEG that is cut off"};
    return {file,
            fmt::format("is a broken or unusual JPEG ({}): save it again with another program",
                        input.complaint.data())};
}

// EXIF 2.3, 4.6.4: tag 274, a SHORT of the first directory; 1 where there is none.
int exif_orientation(std::string_view exif) {
    using namespace std::string_view_literals;
    const bool big_endian = exif.starts_with("MM\0*"sv);
    if (!big_endian && !exif.starts_with("II*\0"sv)) return 1;
    const auto number = [&](std::size_t at, std::size_t count) {
        std::size_t value = 0;
        if (at > exif.size() || count > exif.size() - at) return value;
        for (std::size_t i = 0; i < count; ++i) {
            value = value << 8 |
                    static_cast<unsigned char>(exif[at + (big_endian ? i : count - 1 - i)]);
        }
        return value;
    };
    const std::size_t directory = number(4, 4), entries = number(directory, 2);
    for (std::size_t i = 0; i < entries; ++i) {
        const std::size_t entry = directory + 2 + 12 * i;
        if (number(entry, 2) == 274) return static_cast<int>(number(entry + 8, 2));
    }
    return 1;
}

int jpeg_orientation(const jpeg_decompress_struct& info) {
    using namespace std::string_view_literals;
    for (const jpeg_marker_struct* marker = info.marker_list; marker != nullptr;
         marker = marker->next) {
        const std::string_view data(reinterpret_cast<const char*>(marker->data),
                                    marker->data_length);
        if (data.starts_with("Exif\0\0"sv)) return exif_orientation(data.substr(6));
    }
    return 1;
}

// As Adobe's programs store them: the complements of the inks.
std::vector<std::uint8_t> rgb_of_inks(const std::vector<std::uint8_t>& cmyk) {
    std::vector<std::uint8_t> rgb(cmyk.size() / 4 * 3);
    for (std::size_t i = 0; i < cmyk.size() / 4; ++i) {
        const int black = cmyk[4 * i + 3];
        for (std::size_t c = 0; c < 3; ++c) {
            const int ink = cmyk[4 * i + c];
            rgb[3 * i + c] = static_cast<std::uint8_t>(black - ((255 - ink) * black >> 8));
        }
    }
    return rgb;
}

}  // namespace

DecodedPixels decode_jpeg(const std::string& bytes, const std::filesystem::path& file) {
    JpegInput input;
    input.info.err = jpeg_std_error(&input.errors);
    input.errors.error_exit = leave_jpeg;
    input.errors.emit_message = judge_jpeg_warning;
    input.errors.output_message = say_nothing;
    input.info.client_data = &input;
    if (!read_jpeg_head(input, bytes)) throw jpeg_refusal(input, file);
    const int components = input.info.num_components;
    const int orientation = jpeg_orientation(input.info);  // gone with the last row
    check_size(input.info.image_width, input.info.image_height, bytes.size(), "JPEG", file);
    if (components != 1 && components != 3 && components != 4) {
        throw InputError(file,
                         fmt::format("has {} channels; expected grey, RGB or CMYK", components));
    }
    const std::size_t width = input.info.image_width, height = input.info.image_height,
                      row = width * static_cast<std::size_t>(components);
    std::vector<std::uint8_t> samples(row * height);
    if (!read_jpeg_rows(input, samples.data(), row)) throw jpeg_refusal(input, file);
    if (components == 4) samples = rgb_of_inks(samples);
    return turned_upright({static_cast<int>(width), static_cast<int>(height),
                           components == 1 ? 1 : 3, std::move(samples)},
                          orientation);
}

}  // namespace culet
