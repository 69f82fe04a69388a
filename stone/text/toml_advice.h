#pragma once
// Advice on values that are not TOML or not numbers.

#include <string>
#include <string_view>

namespace culet {

/// `write 6.52 ...` for `6.52mm`, `6,52` or `5%`; empty when `text` is not a number with additions.
std::string number_advice(std::string_view text);

/// Advice on a line that failed to parse: quotes around a text, `=` for `:`, a number without its
/// unit. May be empty.
std::string toml_advice(std::string_view line);

/// Removes a trailing unit that means `unit` (mm, %, deg): `6.52 mm` is `6.52`. Other text is
/// unchanged.
std::string without_unit(std::string_view text, std::string_view unit);

}  // namespace culet
