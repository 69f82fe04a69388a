#include "stone/text/text_decoding.h"

#include <algorithm>
#include <array>

#include "stone/text/errors.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

// Windows code page 1252, 0x80..0x9f; 0: not assigned. The rest equals Latin-1 (Unicode Consortium,
// CP1252.TXT).
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
    } else if (code >= 0x10000) {
        text += static_cast<char>(0xf0 | (code >> 18));
        text += static_cast<char>(0x80 | ((code >> 12) & 0x3f));
        text += static_cast<char>(0x80 | ((code >> 6) & 0x3f));
        text += static_cast<char>(0x80 | (code & 0x3f));
    } else {
        text += static_cast<char>(0xe0 | (code >> 12));
        text += static_cast<char>(0x80 | ((code >> 6) & 0x3f));
        text += static_cast<char>(0x80 | (code & 0x3f));
    }
}

bool is_utf8(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        if (static_cast<unsigned char>(text[at]) < 0x80) {
            ++at;
        } else if (next_code_point(text, at) < 0) {
            return false;
        }
    }
    return true;
}

constexpr std::string_view k_utf16_le_mark = "\xff\xfe", k_utf16_be_mark = "\xfe\xff";
constexpr std::int32_t k_replacement = 0xfffd;

// UTF-16 (RFC 2781); a lone surrogate becomes U+FFFD.
std::string utf8_from_utf16(std::string_view bytes) {
    const bool marked = bytes.starts_with(k_utf16_le_mark) || bytes.starts_with(k_utf16_be_mark);
    const bool little = bytes[marked ? 0 : 1] == (marked ? '\xff' : '\0');
    const auto unit = [&](std::size_t at) {
        const auto a = static_cast<unsigned char>(bytes[at]);
        const auto b = static_cast<unsigned char>(bytes[at + 1]);
        return static_cast<std::uint32_t>(little ? a | (b << 8) : b | (a << 8));
    };
    std::string text;
    text.reserve(bytes.size() / 2);
    for (std::size_t at = marked ? 2 : 0; at + 1 < bytes.size(); at += 2) {
        std::uint32_t code = unit(at);
        if (code >= 0xd800 && code < 0xe000) {
            const std::uint32_t low = at + 3 < bytes.size() ? unit(at + 2) : 0;
            const bool paired = code < 0xdc00 && low >= 0xdc00 && low < 0xe000;
            code = paired ? 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00) : k_replacement;
            if (paired) at += 2;
        }
        append_utf8(text, code);
    }
    return text;
}

// Removes a final Ctrl-Z and what fills the file's last block after it.
std::string_view without_end_mark(std::string_view text) {
    constexpr std::string_view k_filling("\x1a\0 \t\r\n", 6);
    const std::size_t last = text.find_last_not_of(k_filling);
    const std::size_t after = last == std::string_view::npos ? 0 : last + 1;
    return text.substr(0, text.find_first_of(std::string_view("\x1a\0", 2), after));
}

struct Signature {
    std::size_t at;
    std::string_view bytes;
    const char* what;
};

constexpr const char* k_workbook =
    "is an Excel workbook, another office document or a ZIP archive: of a table, save the sheet as "
    "\"CSV UTF-8\"; of an archive, unpack it and name the file inside";
constexpr const char* k_other_picture =
    "is a HEIC or AVIF picture, which is not read: export it as PNG, TIFF or JPEG";

constexpr Signature k_signatures[] = {
    {0, "PK\x03\x04", k_workbook},
    {0, "\xd0\xcf\x11\xe0",
     "is a document of an old Excel or Word: of a table, save the sheet as \"CSV UTF-8\""},
    {0, "%PDF-", "is a PDF document: export its numbers as text (CSV)"},
    {0, "\x1f\x8b", "is compressed (gzip): unpack it first"},
    {0, "7z\xbc\xaf\x27\x1c", "is an archive (7z): unpack it first"},
    {0, "Rar!", "is an archive (RAR): unpack it first"},
    {4, "ftyphei", k_other_picture},
    {4, "ftyphev", k_other_picture},
    {4, "ftypmif1", k_other_picture},
    {4, "ftypavif", k_other_picture},
    {0, "{\\rtf", "is a document of a word processor (RTF): save it as plain text"},
};
// Reported only where text is wanted: other readers accept these.
constexpr Signature k_no_text[] = {
    {0, "\x89PNG", "is a PNG picture, not text"},
    {0, "\xff\xd8\xff", "is a JPEG picture, not text"},
    {0, "glTF", "is a glTF model (.glb), not text: give it that extension"},
    {0, std::string_view("\xff\xfe\0\0", 4), "is text in UTF-32: save it as UTF-8"},
    {0, std::string_view("\0\0\xfe\xff", 4), "is text in UTF-32: save it as UTF-8"},
};

template <class List>
std::string named_by(const List& list, std::string_view bytes) {
    for (const Signature& one : list) {
        if (bytes.size() > one.at && bytes.substr(one.at).starts_with(one.bytes)) return one.what;
    }
    return {};
}

}  // namespace

std::int32_t next_code_point(std::string_view text, std::size_t& at) {
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

bool is_printable(std::int32_t code) {
    const auto within = [code](std::int32_t from, std::int32_t to) {
        return code >= from && code <= to;
    };
    const bool control = code < 0x20 || within(0x7f, 0x9f);
    // The zero-width blank, bidirectional marks, line separators, invisible operators, the byte
    // order mark, annotation and tags (Unicode, general categories Cf, Zl and Zp, except for the
    // joiners that scripts need).
    const bool hidden = code == 0x61c || code == 0x200b || within(0x200e, 0x200f) ||
                        within(0x2028, 0x202e) || within(0x2060, 0x206f) || code == 0xfeff ||
                        within(0xfff9, 0xfffb) || within(0xe0000, 0xe007f);
    return !control && !hidden && !within(0xfdd0, 0xfdef) && (code & 0xfffe) != 0xfffe;
}

bool is_utf16(std::string_view bytes) {
    if (!named_by(k_no_text, bytes).empty()) return false;
    if (bytes.starts_with(k_utf16_le_mark) || bytes.starts_with(k_utf16_be_mark)) return true;
    if (bytes.size() < 4) return false;
    const auto zeros = [&](bool a, bool b, bool c, bool d) {
        return (bytes[0] == 0) == a && (bytes[1] == 0) == b && (bytes[2] == 0) == c &&
               (bytes[3] == 0) == d;
    };
    return zeros(false, true, false, true) || zeros(true, false, true, false);
}

std::string foreign_kind(std::string_view bytes) {
    if (std::string named = named_by(k_signatures, bytes); !named.empty()) return named;
    std::string start = lower_case(std::string(bytes.substr(0, 64)));
    start.erase(0, std::min(start.find_first_not_of("\xef\xbb\xbf \t\r\n"), start.size()));
    if (start.starts_with('<') &&
        (start.substr(1).starts_with("!doctype html") || start.substr(1).starts_with("html")))
        return "is a page of the web (HTML), not the file that it links to: download that";
    return {};
}

std::string decoded_text(std::string_view bytes, const std::filesystem::path& file) {
    for (const std::string& named : {foreign_kind(bytes), named_by(k_no_text, bytes)}) {
        if (!named.empty()) throw InputError(file, named);
    }
    std::string wide;
    if (is_utf16(bytes)) bytes = wide = utf8_from_utf16(bytes);
    if (bytes.starts_with(k_utf8_mark)) bytes.remove_prefix(k_utf8_mark.size());
    bytes = without_end_mark(bytes);
    const bool plain = is_utf8(bytes);
    if (plain && bytes.find('\r') == std::string_view::npos &&
        bytes.find('\0') == std::string_view::npos)
        return std::string(bytes);
    std::string text;
    text.reserve(bytes.size());
    long number = 0;
    while (!bytes.empty()) {
        const std::size_t end = std::min(bytes.find_first_of("\r\n"), bytes.size());
        const std::string_view line = bytes.substr(0, end);
        ++number;
        if (line.find('\0') != std::string_view::npos)
            throw InputError(file, number, "a zero byte: this is not a text file");
        if (plain) {
            text += line;
        } else {
            text += utf8_from_windows1252(line);
        }
        if (end == bytes.size()) break;
        text += '\n';
        bytes.remove_prefix(end + (bytes.substr(end).starts_with("\r\n") ? 2 : 1));
    }
    return text;
}

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
        const std::int32_t code = next_code_point(text, at);
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
