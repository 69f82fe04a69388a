#pragma once
// From the bytes of a text file to UTF-8, the one form in which culet's readers take text.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace culet {

/// The text of a file as UTF-8 with lines that end in LF alone, whatever wrote it:
/// - a byte order mark goes; UTF-16 is told by its mark, or by the zero bytes of its first two
///   letters (as in XML 1.0, appendix F);
/// - lines may end in LF, CRLF or CR: their count stays;
/// - Ctrl-Z, the end of a text file under CP/M and DOS, ends it where only blanks, zeros and Ctrl-Z
///   follow;
/// - a line that is no UTF-8 is taken as Windows-1252.
/// Throws InputError with what the file is and what to do for other things than text: a workbook,
/// an archive, a page of the web, a picture, UTF-32; and with the line for a zero byte.
std::string decoded_text(std::string_view bytes, const std::filesystem::path& file);

/// True for text that `decoded_text` takes as UTF-16.
bool is_utf16(std::string_view bytes);

/// The byte order mark of UTF-8.
constexpr std::string_view k_utf8_mark = "\xef\xbb\xbf";

/// What the first bytes of a file say that it is, and what to do: "is an Excel workbook or ...";
/// empty: none of the files that people give in place of another.
std::string foreign_kind(std::string_view bytes);

/// The code point of UTF-8 at `at`, moved past it; -1 (and one byte on) where the text is no UTF-8.
std::int32_t next_code_point(std::string_view text, std::size_t& at);

/// False for control characters, for marks that reorder or hide text (bidi overrides, zero-width
/// characters), and for what is no character.
bool is_printable(std::int32_t code);

/// Text of Windows-1252 as UTF-8; text that is UTF-8 already stays.
std::string utf8_from_windows1252(std::string_view text);
/// Characters that Windows-1252 lacks become `_`.
std::string windows1252_from_utf8(std::string_view text);

}  // namespace culet
