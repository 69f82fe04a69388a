#pragma once
// What to write instead of a value that is no TOML, or no number.

#include <string>
#include <string_view>

namespace culet {

/// `write 6.52 ...` for `6.52mm`, `6,52` or `5%`; empty when `text` is no number with something
/// about it.
std::string number_advice(std::string_view text);

/// What to write instead of this line of a TOML file, on which parsing ended: quotes about a text,
/// `=` for `:`, a number without its unit. Empty when nothing better is known.
std::string toml_advice(std::string_view line);

/// `text` without a unit at its end that means `unit` (mm, %, deg): `6.52 mm` is `6.52`. Any other
/// text as it is.
std::string without_unit(std::string_view text, std::string_view unit);

}  // namespace culet
