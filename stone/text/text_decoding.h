#pragma once
// Converts the bytes of a text file to UTF-8, which all readers of culet expect.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace culet {

/// Returns a file's text as UTF-8 with LF line ends:
/// - A byte order mark is removed. UTF-16 is recognised by its mark or by the zero bytes of its
///   first two letters (as in XML 1.0, appendix F).
/// - Lines may end in LF, CRLF or CR; their count stays the same.
/// - Ctrl-Z, the end of a text file under CP/M and DOS, ends the text if only blanks, zeros and
///   Ctrl-Z follow.
/// - A line that is not UTF-8 is taken as Windows-1252.
/// Throws InputError for things that are not text (a workbook, an archive, a web page, a picture,
/// UTF-32), saying what the file is and what to do; and for a zero byte, with its line.
std::string decoded_text(std::string_view bytes, const std::filesystem::path& file);

/// True for text that `decoded_text` treats as UTF-16.
bool is_utf16(std::string_view bytes);

constexpr std::string_view k_utf8_mark = "\xef\xbb\xbf";

/// The kind of a file by its first bytes, and what to do: "is an Excel workbook or ..."; empty for
/// files not commonly mistaken for others.
std::string foreign_kind(std::string_view bytes);

/// The UTF-8 code point at `at`, which is moved past it; -1 (and one byte on) for invalid UTF-8.
std::int32_t next_code_point(std::string_view text, std::size_t& at);

/// False for control characters, for marks that reorder or hide text (bidi overrides, zero-width
/// characters), and for non-characters.
bool is_printable(std::int32_t code);

/// UTF-8 text is returned unchanged.
std::string utf8_from_windows1252(std::string_view text);
/// Characters that Windows-1252 lacks become `_`.
std::string windows1252_from_utf8(std::string_view text);

}  // namespace culet
