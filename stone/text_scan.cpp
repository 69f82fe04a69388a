#include "stone/text_scan.h"

#include <algorithm>
#include <cctype>
#include <cfloat>
#include <charconv>
#include <cmath>

namespace culet {

std::optional<std::string_view> LineReader::next() {
    if (position_ >= text_.size()) return std::nullopt;
    const std::size_t start = position_;
    std::size_t end = text_.find_first_of("\r\n", start);
    if (end == std::string_view::npos) end = text_.size();
    position_ = end + 1;
    if (end + 1 < text_.size() && text_[end] == '\r' && text_[end + 1] == '\n') ++position_;
    ++line_;
    return text_.substr(start, end - start);
}

std::vector<std::string_view> words_of(std::string_view line) {
    constexpr std::string_view blanks = " \t\v\f\r\n";
    std::vector<std::string_view> words;
    for (std::size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
        words.push_back(line.substr(at, end - at));
        at = line.find_first_not_of(blanks, end);
    }
    return words;
}

std::string_view trimmed(std::string_view line) {
    constexpr std::string_view blanks = " \t\v\f\r\n";
    const std::size_t start = line.find_first_not_of(blanks);
    if (start == std::string_view::npos) return {};
    return line.substr(start, line.find_last_not_of(blanks) - start + 1);
}

std::string lower_case(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

std::string shown(std::string_view word) {
    std::string text(word.substr(0, 40));
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f) c = '?';
    }
    if (word.size() > 40) text += "...";
    return text;
}

std::optional<double> number_in(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || word.empty()) return std::nullopt;
    if (error == std::errc::result_out_of_range) {
        // Too small is zero; too large is no number.
        const std::size_t exponent = word.find_first_of("eE");
        if (exponent == std::string_view::npos || exponent + 1 >= word.size() ||
            word[exponent + 1] != '-') {
            return std::nullopt;
        }
        return 0.0;
    }
    if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
    return value;
}

std::optional<std::int64_t> integer_in(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || word.empty()) {
        return std::nullopt;
    }
    return value;
}

void WrittenPrecision::add(std::string_view word, double value) {
    largest_ = std::max(largest_, std::abs(value));
    if (value == 0) return;
    // Count the digits of the mantissa from its first that is not zero, and find the place of the
    // last one.
    int digits = 0, decimals = 0, exponent = 0;
    bool after_point = false;
    for (std::size_t i = 0; i < word.size(); ++i) {
        const char c = word[i];
        if (c == '.') {
            after_point = true;
        } else if (c >= '0' && c <= '9') {
            if (digits > 0 || c != '0') ++digits;
            if (after_point) ++decimals;
        } else if (c == 'e' || c == 'E') {
            exponent = static_cast<int>(integer_in(word.substr(i + 1)).value_or(0));
            break;
        }
    }
    const int last_place = std::clamp(exponent - decimals, -47, 16);
    ++count_;
    ++with_last_place_[16 - last_place];
    ++with_digits_[std::clamp(digits, 0, 32)];
    const double half_unit = 0.5 * std::pow(10.0, last_place);
    const double single = static_cast<double>(static_cast<float>(value));
    if (!(std::abs(value - single) <= half_unit * (1 + 1e-9))) all_near_single_ = false;
}

void WrittenPrecision::add_single(double value) {
    largest_ = std::max(largest_, std::abs(value));
    any_single_ = true;
}

void WrittenPrecision::add_double(double value) {
    largest_ = std::max(largest_, std::abs(value));
    if (static_cast<double>(static_cast<float>(value)) != value) all_near_single_ = false;
}

double WrittenPrecision::rounding() const {
    // Numbers that are single precision in disguise carry its rounding however they are written.
    const bool is_single = any_single_ || all_near_single_;
    double rounding = largest_ * (is_single ? FLT_EPSILON / 2 : DBL_EPSILON / 2);
    if (count_ == 0) return rounding;
    // Digits speak of rounding only when most numbers spend as many as any. `%.6f` ends all at one
    // place; `%.6e` and `%g` give all, or most, the same count of digits. In a file of short exact
    // numbers (0.5, 2, 1.25) neither holds.
    long most = 0;
    int last_place = 0;
    for (int i = 0; i < static_cast<int>(with_last_place_.size()); ++i) {
        if (with_last_place_[i] > most) {
            most = with_last_place_[i];
            last_place = 16 - i;
        }
    }
    if (10 * most > 9 * count_) return std::max(rounding, 0.5 * std::pow(10.0, last_place));
    int digits = static_cast<int>(with_digits_.size()) - 1;
    while (digits > 1 && with_digits_[digits] == 0) --digits;
    if (2 * (with_digits_[digits] + with_digits_[digits - 1]) > count_) {
        const double places = std::floor(std::log10(largest_)) + 1 - digits;
        rounding = std::max(rounding, 0.5 * std::pow(10.0, places));
    }
    return rounding;
}

}  // namespace culet
