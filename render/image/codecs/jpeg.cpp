#include <fmt/format.h>
// jpeglib.h needs these before it.
#include <csetjmp>
#include <cstddef>
#include <cstdio>
// After them.
#include <jpeglib.h>
// After it.
#include <jerror.h>
#include <libexif/exif-tag.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>

#include "render/image/codecs/codecs.h"
#include "render/image/codecs/exif.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// libjpeg exits by longjmp, which runs no destructors, so functions that call setjmp hold plain
// values only; the rest is in their callers.
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

// libjpeg continues after damage and fills in grey. Half a photograph is no measurement, so it is
// refused. Other warnings are ignored: cameras cause some (bytes between segments), and no data are
// missing.
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
    jpeg_save_markers(&input.info, JPEG_APP0 + 1, 0xffff);  // EXIF
    jpeg_save_markers(&input.info, JPEG_APP0 + 2, 0xffff);  // ICC
    jpeg_read_header(&input.info, TRUE);
    return true;
}

// Reads to the end of the file.
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

std::string_view data_in(const jpeg_marker_struct& marker) {
    return {reinterpret_cast<const char*>(marker.data), marker.data_length};
}

std::string_view exif_block(const jpeg_decompress_struct& info) {
    using namespace std::string_view_literals;
    for (const jpeg_marker_struct* marker = info.marker_list; marker != nullptr;
         marker = marker->next) {
        if (data_in(*marker).starts_with("Exif\0\0"sv)) return data_in(*marker);
    }
    return {};
}

// Joins a profile's numbered parts (ICC.1:2010, annex B.4).
std::string icc_profile(const jpeg_decompress_struct& info, std::vector<std::string>& notes) {
    using namespace std::string_view_literals;
    constexpr std::size_t k_head = 14;
    std::map<unsigned char, std::string_view> parts;
    std::size_t count = 0;
    for (const jpeg_marker_struct* marker = info.marker_list; marker != nullptr;
         marker = marker->next) {
        const std::string_view data = data_in(*marker);
        if (!data.starts_with("ICC_PROFILE\0"sv) || data.size() < k_head) continue;
        count = static_cast<unsigned char>(data[13]);
        parts[static_cast<unsigned char>(data[12])] = data.substr(k_head);
    }
    std::string profile;
    for (const auto& [number, part] : parts) profile += part;
    if (parts.size() == count) return profile;
    notes.emplace_back("a part of its ICC profile is missing: its colours are taken as sRGB");
    return {};
}

// Without a profile, EXIF may name Adobe RGB, or say that the colours are uncalibrated.
SampleMeaning meaning_of_jpeg(const jpeg_decompress_struct& info, const ExifFields& exif) {
    constexpr int k_uncalibrated = 0xffff, k_adobe = 2;
    SampleMeaning meaning;
    meaning.profile = icc_profile(info, meaning.notes);
    const double space = exif.number(EXIF_TAG_COLOR_SPACE);
    if (exif.adobe_rgb() || space == k_adobe) {
        meaning.colours = "Adobe RGB (1998)";
        meaning.primaries = k_adobe_rgb_primaries;
        meaning.exponent = k_adobe_rgb_exponent;
    } else if (space == k_uncalibrated && meaning.profile.empty()) {
        meaning.notes.emplace_back(
            "its EXIF says that its colours are not those of sRGB, and no profile which they are: "
            "they are taken as sRGB");
    }
    if (info.saw_JFIF_marker && info.density_unit == 0 && info.X_density > 0)
        meaning.pixel_aspect = static_cast<double>(info.Y_density) / info.X_density;
    meaning.inks = info.num_components == 4;
    return meaning;
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
    check_size(input.info.image_width, input.info.image_height, bytes.size(), "JPEG", file);
    if (components != 1 && components != 3 && components != 4) {
        throw InputError(file,
                         fmt::format("has {} channels; expected grey, RGB or CMYK", components));
    }
    // Read the markers before the last row: they are freed with it.
    const ExifFields exif(exif_block(input.info));
    DecodedPixels result;
    result.meaning = meaning_of_jpeg(input.info, exif);
    const std::size_t width = input.info.image_width, height = input.info.image_height,
                      row = width * static_cast<std::size_t>(components);
    std::vector<std::uint8_t> samples(row * height);
    if (!read_jpeg_rows(input, samples.data(), row)) throw jpeg_refusal(input, file);
    // Adobe's programs, which mark their files, store inks as complements.
    if (components == 4 && input.info.saw_Adobe_marker) {
        for (std::uint8_t& v : samples) v = static_cast<std::uint8_t>(255 - v);
    }
    result.width = static_cast<int>(width);
    result.height = static_cast<int>(height);
    result.channels = components;
    result.samples = std::move(samples);
    return turned_upright(std::move(result), exif.orientation());
}

}  // namespace culet
