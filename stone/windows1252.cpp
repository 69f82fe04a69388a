#include <array>
#include <cstdint>

#include "stone/cut_planes.h"

namespace culet {

namespace {

// Windows code page 1252, 0x80..0x9f; 0: not assigned. The rest equals Latin-1 (Unicode
// Consortium, CP1252.TXT).
constexpr std::array<std::uint16_t, 32> k_high{
    0x20ac, 0,      0x201a, 0x0192, 0x201e, 0x2026, 0x2020, 0x2021, 0x02c6, 0x2030, 0x0160,
    0x2039, 0x0152, 0,      0x017d, 0,      0,      0x2018, 0x2019, 0x201c, 0x201d, 0x2022,
    0x2013, 0x2014, 0x02dc, 0x2122, 0x0161, 0x203a, 0x0153, 0,      0x017e, 0x0178};

void append_utf8(std::string& text, std::uint32_t code) {
    if (code < 0x80) {
        text += static_cast<char>(code);
    } else if (code < 0x800) {
        text += static_cast<char>(0xc0 | (code >> 6));
        text += static_cast<char>(0x80 | (code & 0x3f));
    } else {
        text += static_cast<char>(0xe0 | (code >> 12));
        text += static_cast<char>(0x80 | ((code >> 6) & 0x3f));
        text += static_cast<char>(0x80 | (code & 0x3f));
    }
}

/// The code point at `at`, moved past it; -1 (and one byte on) where the text is no UTF-8.
std::int32_t next_code(std::string_view text, std::size_t& at) {
    const auto first = static_cast<unsigned char>(text[at++]);
    if (first < 0x80) return first;
    const int more = first >= 0xf0 && first < 0xf5 ? 3 : first >= 0xe0 ? 2 : first >= 0xc2 ? 1 : 0;
    if (more == 0 || first >= 0xf5 || at + static_cast<std::size_t>(more) > text.size()) return -1;
    std::int32_t code = first & (0x3f >> more);
    for (int k = 0; k < more; ++k) {
        const auto next = static_cast<unsigned char>(text[at + static_cast<std::size_t>(k)]);
        if ((next & 0xc0) != 0x80) return -1;
        code = (code << 6) | (next & 0x3f);
    }
    const bool overlong = (more == 2 && code < 0x800) || (more == 3 && code < 0x10000);
    if (overlong || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return -1;
    at += static_cast<std::size_t>(more);
    return code;
}

bool is_utf8(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        if (next_code(text, at) < 0) return false;
    }
    return true;
}

}  // namespace

std::string utf8_from_windows1252(std::string_view text) {
    if (is_utf8(text)) return std::string(text);
    std::string converted;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        std::uint32_t code = byte;
        if (byte >= 0x80 && byte < 0xa0)
            code = k_high[byte - 0x80] != 0 ? k_high[byte - 0x80] : '_';
        append_utf8(converted, code);
    }
    return converted;
}

std::string windows1252_from_utf8(std::string_view text) {
    std::string converted;
    for (std::size_t at = 0; at < text.size();) {
        const std::int32_t code = next_code(text, at);
        char byte = '_';
        if ((code >= 0 && code < 0x80) || (code >= 0xa0 && code < 0x100)) {
            byte = static_cast<char>(code);
        }
        for (std::size_t k = 0; k < k_high.size(); ++k) {
            if (code > 0 && k_high[k] == code) byte = static_cast<char>(0x80 + k);
        }
        converted += byte;
    }
    return converted;
}

}  // namespace culet
