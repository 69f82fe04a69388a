#include "stone/text/written_number.h"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "stone/text/text_scan.h"

namespace culet {

namespace {

using Of = WrittenUnit::Of;

struct UnitWord {
    const char* word;
    WrittenUnit::Of of;
    double factor;
};

constexpr std::array<UnitWord, 37> k_units{{
    {"mm", Of::length, 1},         {"millimetre", Of::length, 1},  {"millimetres", Of::length, 1},
    {"millimeter", Of::length, 1}, {"millimeters", Of::length, 1}, {"cm", Of::length, 10},
    {"m", Of::length, 1000},       {"in", Of::length, 25.4},       {"inch", Of::length, 25.4},
    {"inches", Of::length, 25.4},  {"\"", Of::length, 25.4},       {"um", Of::length, 1e-3},
    {"\u00b5m", Of::length, 1e-3}, {"\u03bcm", Of::length, 1e-3},  {"deg", Of::angle, 1},
    {"deg.", Of::angle, 1},        {"degree", Of::angle, 1},       {"degrees", Of::angle, 1},
    {"\u00b0", Of::angle, 1},      {"\u00ba", Of::angle, 1},       {"ct", Of::weight, 1},
    {"ct.", Of::weight, 1},        {"cts", Of::weight, 1},         {"carat", Of::weight, 1},
    {"carats", Of::weight, 1},     {"g", Of::weight, 5},           {"gram", Of::weight, 5},
    {"grams", Of::weight, 5},      {"mg", Of::weight, 0.005},      {"mm3", Of::volume, 1},
    {"mm^3", Of::volume, 1},       {"mm\u00b3", Of::volume, 1},    {"cm3", Of::volume, 1000},
    {"cm^3", Of::volume, 1000},    {"cm\u00b3", Of::volume, 1000}, {"%", Of::percent, 1},
    {"percent", Of::percent, 1},
}};

// Removes it from `text`.
std::optional<double> leading_number(std::string& text) {
    const char* begin = text.data();
    if (*begin == '+') ++begin;
    double value = 0;
    const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
    if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
    text = trimmed(std::string_view(end, std::size_t(text.data() + text.size() - end)));
    return value;
}

// 33,8 as 33.8; nothing where a comma may mean something else.
std::optional<std::string> with_decimal_point(std::string text, bool comma_separates) {
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos) return text;
    const std::string_view digits_of =
        std::string_view(text).substr(0, text.find_first_not_of("0123456789.,+-"));
    if (text.find(',', comma + 1) != std::string::npos || digits_of.find('.') < digits_of.size()) {
        return std::nullopt;
    }
    std::size_t digits = 0;
    while (comma + 1 + digits < text.size() &&
           std::isdigit(static_cast<unsigned char>(text[comma + 1 + digits])) != 0) {
        ++digits;
    }
    // 0,015 is not a thousand.
    const bool thousand = digits == 3 && digits_of.find_first_of("123456789") < comma;
    if (digits == 0 || (comma_separates && thousand)) return std::nullopt;
    text[comma] = '.';
    return text;
}

// 48' or 48' 30" after the degrees, as a fraction of a degree.
std::optional<double> minutes_and_seconds(std::string rest) {
    const std::array<std::pair<double, std::array<const char*, 3>>, 2> marks{
        {{60, {"'", "\u2032", "\u2019"}}, {3600, {"\"", "\u2033", "''"}}}};
    double sum = 0;
    for (const auto& [parts, signs] : marks) {
        if (rest.empty()) break;
        const auto number = leading_number(rest);
        if (!number || *number < 0 || *number >= 60) return std::nullopt;
        bool marked = false;
        for (const char* sign : signs) {
            if (marked || !rest.starts_with(sign)) continue;
            rest = trimmed(std::string_view(rest).substr(std::string_view(sign).size()));
            marked = true;
        }
        if (!marked) return std::nullopt;
        sum += *number / parts;
    }
    return rest.empty() ? std::optional(sum) : std::nullopt;
}

}  // namespace

WrittenNumber written_number(std::string_view written, bool comma_separates) {
    WrittenNumber number;
    const std::string text(trimmed(written));
    const auto fail = [&](const std::string& expected) {
        number.problem = fmt::format("is '{}'; expected {}", shown(text), expected);
        return number;
    };
    std::string rest = text;
    if (rest.starts_with("\u00b1")) rest = trimmed(rest.substr(2));
    rest = with_plain_minus(rest);
    const auto pointed = with_decimal_point(rest, comma_separates);
    if (!pointed) return fail("one decimal mark and no others, such as 34.5");
    rest = *pointed;
    const auto value = leading_number(rest);
    if (!value) return fail("a finite number such as 34.5");
    number.value = *value;
    if (rest.empty()) return number;
    for (const std::string_view of : {"/", "of "}) {
        if (!rest.starts_with(of)) continue;
        std::string teeth(trimmed(std::string_view(rest).substr(of.size())));
        const auto count = leading_number(teeth);
        if (!count || !teeth.empty() || std::abs(*count) < 1) {
            return fail("a tooth of an index wheel such as 12 of 96");
        }
        number.unit = {Of::teeth, *count, rest};
        return number;
    }
    if (rest.starts_with("\u00b1") || rest.starts_with("+-") || rest.starts_with("+/-"))
        return fail("the value alone: its uncertainty stands in the column sigma");
    const std::string word = lower_case(rest);
    for (const UnitWord& unit : k_units) {
        if (word != unit.word) continue;
        number.unit = {unit.of, unit.factor, rest};
        return number;
    }
    for (const std::string_view degree : {"\u00b0", "\u00ba"}) {
        if (!rest.starts_with(degree)) continue;
        const auto part =
            minutes_and_seconds(std::string(trimmed(std::string_view(rest).substr(degree.size()))));
        if (!part || number.value != std::floor(number.value)) break;
        number.value += std::signbit(number.value) ? -*part : *part;
        number.unit = {Of::angle, 1, rest};
        return number;
    }
    return fail("a number such as 34.5, alone or with its unit (mm, deg, ct)");
}

}  // namespace culet
