#pragma once
// Small pieces of a page. Everything from files goes through `escaped`.

#include <optional>
#include <string>
#include <string_view>

namespace culet {

/// The system's fonts, for drawings and charts.
inline constexpr const char* k_svg_font =
    "system-ui, 'Segoe UI', 'Liberation Sans', Arial, sans-serif";

/// Makes text safe in HTML and in quoted attributes: & < > " ' become entities; control characters
/// and invalid UTF-8 become U+FFFD.
std::string escaped(std::string_view text);

/// Returns JSON without `<`.
std::string json_for_script(std::string_view json);

std::string base64(std::string_view bytes);
/// Returns nothing for invalid base64 (RFC 4648, section 4, padding required).
std::optional<std::string> bytes_of_base64(std::string_view text);

/// `data:image/png;base64,...`
std::string png_uri(std::string_view png);
/// The same for the bytes of a JPEG or PNG file, by how it begins; empty for others.
std::string picture_uri(std::string_view file);

/// Writes `count` decimals and a true minus sign; a dash for nothing, NaN and infinity.
std::string decimals(const std::optional<double>& value, int count);

/// Writes no decimals.
std::string whole(const std::optional<double>& value);

/// Quotes for a POSIX shell where necessary.
std::string shell_word(const std::string& word);

/// Adds a capital and a full stop. Not escaped.
std::string as_sentence(std::string text);

/// Writes `count` significant digits without trailing zeros from rounding: 0.00123, 12.3, 1230.
std::string significant(const std::optional<double>& value, int count = 3);

}  // namespace culet
