#pragma once
// Measured values as people write them: to the digit that the uncertainty allows, units typeset.
// Plain text, not escaped.

#include <optional>
#include <string>
#include <string_view>

namespace culet {

/// "deg" -> "°", "mm3" -> " mm³", "" -> "": what follows the number, a no-break space included.
std::string unit_suffix(std::string_view unit);

/// Below this the unit's displays show nothing: a smaller sigma is that of what is held exactly.
double finest_of(std::string_view unit);

inline constexpr int k_any_place = 99;

/// "33.784 ± 0.099°": sigma to two digits, the value to the same place. "0° (held exactly)" where
/// sigma is finer than `finest_of`; the value alone where there is no sigma (none, NaN, infinite,
/// negative); "–" without a value; "not known" for an angle whose sigma is a right angle or more.
/// `most_places`: decimals of what is read, beyond which sigma's second digit says nothing.
std::string quantity(const std::optional<double>& value, const std::optional<double>& sigma,
                     std::string_view unit, int most_places = k_any_place);

/// The same for a terminal of plain letters: "+-" for the sign, a plain minus and blank.
std::string plain_signs(std::string text);

/// The value alone, to the place that sigma allows, with its unit: fitted values, residuals.
std::string to_place_of(const std::optional<double>& value, const std::optional<double>& sigma,
                        std::string_view unit);

/// A reading as the display showed it: no digits that nobody read.
std::string as_read(const std::optional<double>& value, std::string_view unit);

/// The smallest slip that would be noticed in a reading of `value`. A slip as large as that tells
/// nobody anything (of angles: 90°; of lengths: the length): "any slip would pass".
std::string smallest_slip(const std::optional<double>& detectable,
                          const std::optional<double>& value, std::string_view unit);

/// A sentence of the fit, typeset: "0.6 degrees (+- 0.1)" -> "0.6° (± 0.1)", "mm3" -> "mm³". Only
/// behind a digit or a blank, so that names stay what they are.
std::string typeset(std::string_view sentence);

}  // namespace culet
