#pragma once
// Advice on what to write instead of a value that is not TOML or not a number.

#include <string>
#include <string_view>

namespace culet {

/// `write 6.52 ...` for `6.52mm`, `6,52` or `5%`; empty when `text` is not a number with additions.
std::string number_advice(std::string_view text);

/// What to write instead of a line of a TOML file that failed to parse: quotes around a text, `=`
/// for `:`, a number without its unit. Empty when there is no advice.
std::string toml_advice(std::string_view line);

/// `text` without a trailing unit that means `unit` (mm, %, deg): `6.52 mm` is `6.52`. Any other
/// text is returned unchanged.
std::string without_unit(std::string_view text, std::string_view unit);

}  // namespace culet
