#include "render/image/picture_header.h"

#include <array>
#include <charconv>

namespace culet {

namespace {

/// `count` bytes from `at` as one number; 0 past the end.
std::uint64_t number(std::string_view bytes, std::size_t at, std::size_t count, bool big_endian) {
    if (at > bytes.size() || count > bytes.size() - at) return 0;
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t k = big_endian ? i : count - 1 - i;
        value = value << 8 | static_cast<std::uint8_t>(bytes[at + k]);
    }
    return value;
}

// PNG, second edition (ISO/IEC 15948), 11.2.2: IHDR comes first.
void read_png(std::string_view bytes, PictureHeader& header) {
    header.width = number(bytes, 16, 4, true);
    header.height = number(bytes, 20, 4, true);
}

// ITU-T T.81, B.2.2: segments up to the start of frame (SOF0..SOF15 without DHT, JPG, DAC).
void read_jpeg(std::string_view bytes, PictureHeader& header) {
    std::size_t at = 2;
    while (at + 9 < bytes.size()) {
        if (static_cast<std::uint8_t>(bytes[at]) != 0xff) {
            ++at;
            continue;
        }
        const auto marker = static_cast<std::uint8_t>(bytes[at + 1]);
        const bool frame =
            marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
        if (frame) {
            header.height = number(bytes, at + 5, 2, true);
            header.width = number(bytes, at + 7, 2, true);
            return;
        }
        const bool without_length =
            marker == 0xff || marker == 0x01 || (marker >= 0xd0 && marker <= 0xd9);
        at += without_length ? 1 : 2 + static_cast<std::size_t>(number(bytes, at + 2, 2, true));
        if (marker == 0xda) return;
    }
}

// TIFF 6.0, section 2: the first directory's tags 256 and 257, each SHORT or LONG.
void read_tiff(std::string_view bytes, PictureHeader& header) {
    const bool big_endian = bytes[0] == 'M';
    const auto directory = static_cast<std::size_t>(number(bytes, 4, 4, big_endian));
    const std::uint64_t entries = number(bytes, directory, 2, big_endian);
    for (std::uint64_t i = 0; i < entries; ++i) {
        const std::size_t entry = directory + 2 + 12 * static_cast<std::size_t>(i);
        const std::uint64_t tag = number(bytes, entry, 2, big_endian);
        const std::size_t size = number(bytes, entry + 2, 2, big_endian) == 3 ? 2 : 4;
        const std::uint64_t value = number(bytes, entry + 8, size, big_endian);
        if (tag == 256) header.width = value;
        if (tag == 257) header.height = value;
    }
}

// OpenEXR file layout: the attribute `dataWindow` of type `box2i`, 16 bytes, little endian.
void read_exr(std::string_view bytes, PictureHeader& header) {
    using namespace std::string_view_literals;
    const auto name = "dataWindow\0box2i\0"sv;
    const std::size_t at = bytes.substr(0, 65536).find(name);
    if (at == std::string_view::npos) return;
    const auto corner = [&](std::size_t i) {
        return static_cast<std::int64_t>(
            static_cast<std::int32_t>(number(bytes, at + name.size() + 4 + 4 * i, 4, false)));
    };
    const std::int64_t width = corner(2) - corner(0) + 1, height = corner(3) - corner(1) + 1;
    header.width = width > 0 ? static_cast<std::uint64_t>(width) : 0;
    header.height = height > 0 ? static_cast<std::uint64_t>(height) : 0;
}

// The first two whole numbers of a text; 0 0 when there are not so many.
std::array<std::uint64_t, 2> two_numbers(std::string_view text) {
    std::array<std::uint64_t, 2> found{};
    std::size_t at = 0;
    for (std::uint64_t& value : found) {
        at = text.find_first_of("0123456789", at);
        if (at == std::string_view::npos) return {};
        const auto [stop, error] =
            std::from_chars(text.data() + at, text.data() + text.size(), value);
        if (error != std::errc()) return {};
        at = static_cast<std::size_t>(stop - text.data());
    }
    return found;
}

// Radiance: the resolution line `-Y rows +X columns` after an empty line.
void read_hdr(std::string_view bytes, PictureHeader& header) {
    const std::size_t end = bytes.substr(0, 65536).find("\n\n");
    if (end == std::string_view::npos) return;
    const std::string_view line = bytes.substr(end + 2, 128);
    const auto [rows, columns] = two_numbers(line.substr(0, line.find('\n')));
    header.height = rows;
    header.width = columns;
}

// PFM (Debevec): `PF` or `Pf`, columns and rows, scale, each on a line.
void read_pfm(std::string_view bytes, PictureHeader& header) {
    const auto [columns, rows] = two_numbers(bytes.substr(3, 64));
    header.width = columns;
    header.height = rows;
}

}  // namespace

PictureHeader picture_header(std::string_view bytes) {
    using namespace std::string_view_literals;
    PictureHeader header;
    if (bytes.starts_with("\x89PNG\r\n\x1a\n"sv)) {
        header.format = "PNG";
        read_png(bytes, header);
    } else if (bytes.starts_with("\xff\xd8\xff"sv)) {
        header.format = "JPEG";
        read_jpeg(bytes, header);
    } else if (bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv)) {
        header.format = "TIFF";
        read_tiff(bytes, header);
    } else if (bytes.starts_with("\x76\x2f\x31\x01"sv)) {
        header.format = "EXR";
        read_exr(bytes, header);
    } else if (bytes.starts_with("#?RADIANCE"sv) || bytes.starts_with("#?RGBE"sv)) {
        header.format = "HDR";
        read_hdr(bytes, header);
    } else if (bytes.starts_with("PF\n"sv) || bytes.starts_with("Pf\n"sv)) {
        header.format = "PFM";
        read_pfm(bytes, header);
    }
    return header;
}

}  // namespace culet
