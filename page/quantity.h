#pragma once
// Measured values as people write them: digits as the uncertainty justifies, units typeset. Plain
// text, not escaped.

#include <optional>
#include <string>
#include <string_view>

namespace culet {

/// What follows the number, with a no-break space: "deg" -> "°", "mm3" -> " mm³", "" -> "".
std::string unit_suffix(std::string_view unit);

/// The finest step of displays in this unit. A smaller sigma means a value that is held exactly.
double finest_of(std::string_view unit);

inline constexpr int k_any_place = 99;

/// "33.784 ± 0.099°": sigma to two digits, the value to the same place. Special cases:
/// - "0° (held exactly)" if sigma is smaller than `finest_of`;
/// - the value alone without a valid sigma (missing, NaN, infinite, negative);
/// - "–" without a value;
/// - "not known" for an angle with a sigma of a right angle or more.
/// `most_places`: most decimals to write, for readings whose display has no more.
std::string quantity(const std::optional<double>& value, const std::optional<double>& sigma,
                     std::string_view unit, int most_places = k_any_place);

/// The same for plain terminals: "+-" for the sign, a plain minus and blank.
std::string plain_signs(std::string text);

/// The value to the place that sigma allows, with its unit; for fitted values and residuals.
std::string to_place_of(const std::optional<double>& value, const std::optional<double>& sigma,
                        std::string_view unit);

/// A reading as the display showed it, without digits that nobody read.
std::string as_read(const std::optional<double>& value, std::string_view unit);

/// The smallest slip in a reading of `value` that would be noticed; "any slip would pass" if that
/// is useless (angles: 90°; lengths: the length itself).
std::string smallest_slip(const std::optional<double>& detectable,
                          const std::optional<double>& value, std::string_view unit);

/// Rewrites "0.6 degrees (+- 0.1)" as "0.6° (± 0.1)", "mm3" as "mm³". Changes units only after a
/// digit or a blank, so that names stay as they are.
std::string typeset(std::string_view sentence);

}  // namespace culet
