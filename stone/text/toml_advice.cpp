#include "stone/text/toml_advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include "stone/text/text_scan.h"

namespace culet {

namespace {

bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

struct LeadingNumber {
    double value = 0;
    std::string_view digits, rest;  ///< as written; what follows, without blanks at its ends
};

std::optional<LeadingNumber> leading_number(std::string_view text) {
    text = trimmed(text);
    if (text.starts_with('+')) text.remove_prefix(1);
    LeadingNumber number;
    const auto [end, problem] =
        std::from_chars(text.data(), text.data() + text.size(), number.value);
    if (problem != std::errc() || !std::isfinite(number.value)) return std::nullopt;
    const auto length = static_cast<std::size_t>(end - text.data());
    number.digits = text.substr(0, length);
    number.rest = trimmed(text.substr(length));
    return number;
}

bool means(std::string_view written, std::string_view unit) {
    if (written == unit) return true;
    if (unit.starts_with("deg"))
        return written == "deg" || written == "degrees" || written == "degree" ||
               written == "\u00b0";
    if (unit == "%") return written == "percent" || written == "per cent";
    return false;
}

std::string_view without_comment(std::string_view value) {
    const std::size_t hash = value.find('#');
    return hash == std::string_view::npos ? value : trimmed(value.substr(0, hash));
}

bool is_word_of_toml(std::string_view value) {
    return value == "true" || value == "false" || value == "inf" || value == "nan";
}

}  // namespace

std::string number_advice(std::string_view text) {
    if (const std::string plain = with_plain_minus(text); plain != text && leading_number(plain))
        return fmt::format("write {} with a plain hyphen", shown(plain));
    const auto number = leading_number(text);
    if (!number || number->rest.empty()) return {};
    const std::string_view rest = number->rest;
    if (rest == "%") {
        return fmt::format("write {:g} for a fraction, {} for per cent", number->value / 100,
                           number->digits);
    }
    const bool decimals = rest.size() > 1 && rest.front() == ',' &&
                          std::all_of(rest.begin() + 1, rest.end(), is_digit);
    if (decimals) return fmt::format("write {}.{} with a point", number->digits, rest.substr(1));
    const bool unit = rest.size() <= 8 && std::none_of(rest.begin(), rest.end(), is_digit);
    if (unit) return fmt::format("write {} without \"{}\"", number->digits, rest);
    return {};
}

std::string toml_advice(std::string_view line) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) {
        const std::size_t colon = line.find(':');
        const std::string_view key = trimmed(line.substr(0, colon));
        if (colon == std::string_view::npos || key.empty() || key.starts_with('#')) return {};
        return fmt::format("write {} = {}, with =", shown(key),
                           shown(trimmed(line.substr(colon + 1))));
    }
    const std::string_view key = trimmed(line.substr(0, equals));
    const std::string_view value = without_comment(trimmed(line.substr(equals + 1)));
    if (value.empty()) return fmt::format("a value is missing behind {} =", shown(key));
    if (std::string advice = number_advice(value); !advice.empty()) return advice;
    const char first = value.front();
    if (first == '"' || first == '\'') {
        return std::count(value.begin(), value.end(), first) == 1 ? "a quote is not closed" : "";
    }
    // For values inside lists and tables only the parser reports errors.
    if (first == '[' || first == '{' || is_word_of_toml(value)) return {};
    const auto number = leading_number(value);
    if (number && number->rest.empty()) return {};
    if (value.find('"') != std::string_view::npos) return "a text needs quotes about all of it";
    return fmt::format("put quotes about a text: {} = \"{}\"", shown(key), shown(value));
}

std::string without_unit(std::string_view text, std::string_view unit) {
    const auto number = leading_number(text);
    if (!number || !means(number->rest, unit)) return std::string(text);
    return std::string(number->digits);
}

}  // namespace culet
