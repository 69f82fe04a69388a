#pragma once
// Small pieces of a page. Whatever comes from a file goes through `escaped`.

#include <optional>
#include <string>
#include <string_view>

namespace culet {

/// Of drawings and charts: what the reader's machine has.
inline constexpr const char* k_svg_font =
    "system-ui, 'Segoe UI', 'Liberation Sans', Arial, sans-serif";

/// Safe as text and inside a quoted attribute: & < > " ' become entities; control characters and
/// bytes that are not UTF-8 become U+FFFD.
std::string escaped(std::string_view text);

/// JSON text that may stand inside a script element: no `<` is left in it.
std::string json_for_script(std::string_view json);

std::string base64(std::string_view bytes);
/// Nothing for what is no base64 (RFC 4648, section 4, with its padding).
std::optional<std::string> bytes_of_base64(std::string_view text);

/// `data:image/png;base64,...`
std::string png_uri(std::string_view png);

/// With that many decimals and a true minus sign; a dash for nothing, NaN and infinity.
std::string decimals(const std::optional<double>& value, int count);

/// A count: no decimals.
std::string whole(const std::optional<double>& value);

/// One word of a command line for a POSIX shell: quoted where it must be.
std::string shell_word(const std::string& word);

/// With a capital in front and a stop behind. Not escaped.
std::string as_sentence(std::string text);

/// To that many significant digits, without trailing noise: 0.00123, 12.3, 1230.
std::string significant(const std::optional<double>& value, int count = 3);

}  // namespace culet
