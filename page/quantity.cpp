#include "page/quantity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "page/html.h"

namespace culet {

namespace {

constexpr const char* k_none = "–";
// From here on two digits of a sigma are not written out.
constexpr double k_largest_written = 1e7;
constexpr double k_right_angle_deg = 90;

bool given(const std::optional<double>& value) {
    return value && std::isfinite(*value);
}

/// Decimal place of sigma's second digit: 2 for 0.099, -1 for 120. Counted after rounding, so that
/// 0.0996 is 0.10 and not 0.100.
int place_of(double sigma) {
    const auto exponent = [](double s) { return static_cast<int>(std::floor(std::log10(s))); };
    int place = 1 - exponent(sigma);
    const double unit = std::pow(10.0, -place);
    if (std::round(sigma / unit) >= 100) --place;
    return place;
}

std::string in_place(double value, int place) {
    if (place >= 0) return decimals(value, place);
    const double unit = std::pow(10.0, -place);
    return decimals(std::round(value / unit) * unit, 0);
}

/// Rounds to the unit's finest place, without trailing zeros.
std::string trimmed(double value, std::string_view unit) {
    if (!(std::abs(value) < k_largest_written)) return significant(value, 6);
    std::string text = decimals(value, static_cast<int>(std::round(-std::log10(finest_of(unit)))));
    if (text.find('.') == std::string::npos) return text;
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

}  // namespace

std::string unit_suffix(std::string_view unit) {
    if (unit.empty()) return {};
    if (unit == "deg") return "°";
    std::string text = "\u00a0";
    const char last = unit.back();
    const bool power = unit.size() > 1 && (last == '2' || last == '3');
    text += power ? unit.substr(0, unit.size() - 1) : unit;
    if (power) text += last == '2' ? "²" : "³";
    return text;
}

double finest_of(std::string_view unit) {
    if (unit == "deg" || unit == "mm" || unit == "mm2" || unit == "mm3") return 1e-4;
    if (unit == "%") return 1e-3;
    if (unit == "m") return 1e-7;
    return 1e-5;
}

std::string to_place_of(const std::optional<double>& value, const std::optional<double>& sigma,
                        std::string_view unit) {
    if (!given(value)) return k_none;
    const bool usable = given(sigma) && *sigma >= finest_of(unit) && *sigma < k_largest_written &&
                        std::abs(*value) < k_largest_written * k_largest_written;
    if (usable) return in_place(*value, place_of(*sigma)) + unit_suffix(unit);
    if (given(sigma) && *sigma >= 0 && *sigma < finest_of(unit)) {
        return trimmed(*value, unit) + unit_suffix(unit);
    }
    return significant(*value, 5) + unit_suffix(unit);
}

std::string quantity(const std::optional<double>& value, const std::optional<double>& sigma,
                     std::string_view unit, int most_places) {
    if (!given(value)) return k_none;
    const std::string suffix = unit_suffix(unit);
    if (!given(sigma) || *sigma < 0) return to_place_of(value, std::nullopt, unit);
    if (*sigma < finest_of(unit)) return trimmed(*value, unit) + suffix + " (held exactly)";
    if (unit == "deg" && *sigma >= k_right_angle_deg) return "not known";
    if (*sigma >= k_largest_written || std::abs(*value) >= k_largest_written * k_largest_written) {
        return significant(*value, 2) + " ± " + significant(*sigma, 2) + suffix;
    }
    // At least one digit of sigma.
    const int place = place_of(*sigma), shown = std::min(place, std::max(most_places, place - 1));
    return in_place(*value, shown) + " ± " + in_place(*sigma, shown) + suffix;
}

std::string plain_signs(std::string text) {
    for (const auto& [from, to] :
         {std::pair("±", "+-"), std::pair("−", "-"), std::pair("–", "-"), std::pair("≤ ", "<="),
          std::pair("×", "x"), std::pair("\u00a0", " "), std::pair("°", " deg")}) {
        for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from))
            text.replace(at, std::string(from).size(), to);
    }
    return text;
}

std::string as_read(const std::optional<double>& value, std::string_view unit) {
    return given(value) ? trimmed(*value, unit) + unit_suffix(unit) : k_none;
}

std::string smallest_slip(const std::optional<double>& detectable,
                          const std::optional<double>& value, std::string_view unit) {
    if (!given(detectable) || !(*detectable > 0)) return k_none;
    const bool blind = unit == "deg"                 ? *detectable >= k_right_angle_deg
                       : given(value) && *value != 0 ? *detectable >= std::abs(*value)
                                                     : false;
    if (blind || *detectable >= k_largest_written) return "any slip would pass";
    return to_place_of(detectable, detectable, unit);
}

std::string typeset(std::string_view sentence) {
    static constexpr std::pair<std::string_view, std::string_view> k_signs[] = {
        {" degrees", "°"}, {" um", " µm"}, {"+- ", "± "}, {"mm3", "mm³"}, {"mm2", "mm²"}};
    const auto of_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
    std::string result;
    for (std::size_t at = 0; at < sentence.size();) {
        const std::string_view rest = sentence.substr(at);
        const char before = at == 0 ? ' ' : sentence[at - 1];
        const auto fits = [&](const auto& sign) {
            if (!rest.starts_with(sign.first)) return false;
            const bool ends = rest.size() == sign.first.size() || !of_word(rest[sign.first.size()]);
            if (sign.first.starts_with(' ')) {
                return ends && std::isdigit(static_cast<unsigned char>(before)) != 0;
            }
            if (sign.first == "+- ") return before == ' ' || before == '(';
            return ends && before == ' ';
        };
        const auto* const sign = std::find_if(std::begin(k_signs), std::end(k_signs), fits);
        if (sign == std::end(k_signs)) {
            result += sentence[at++];
        } else {
            result += sign->second;
            at += sign->first.size();
        }
    }
    return result;
}

}  // namespace culet
