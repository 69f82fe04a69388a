#include "stone/text/text_scan.h"

#include <algorithm>
#include <cctype>
#include <cfloat>
#include <charconv>
#include <cmath>

#include "stone/text/text_decoding.h"

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

namespace {

constexpr std::string_view k_wide_blanks[] = {"\u00a0", "\u2007", "\u2009",
                                              "\u202f", "\u3000", "\ufeff"};

// The number of bytes; 0: none.
std::size_t blank_before(std::string_view text) {
    const char c = text.front();
    if (c == ' ' || (c >= '\t' && c <= '\r')) return 1;
    if (static_cast<unsigned char>(c) < 0x80) return 0;
    for (const std::string_view blank : k_wide_blanks) {
        if (text.starts_with(blank)) return blank.size();
    }
    return 0;
}

std::size_t blank_behind(std::string_view text) {
    const char c = text.back();
    if (static_cast<unsigned char>(c) < 0x80) return blank_before(text.substr(text.size() - 1));
    for (const std::string_view blank : k_wide_blanks) {
        if (text.ends_with(blank)) return blank.size();
    }
    return 0;
}

}  // namespace

std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    for (std::size_t at = 0, start = 0; at <= line.size();) {
        const std::size_t blank = at < line.size() ? blank_before(line.substr(at)) : 1;
        if (blank > 0 && at > start) words.push_back(line.substr(start, at - start));
        at += std::max<std::size_t>(blank, 1);
        if (blank > 0) start = at;
    }
    return words;
}

std::string_view trimmed(std::string_view line) {
    while (!line.empty()) {
        const std::size_t blank = blank_before(line);
        if (blank == 0) break;
        line.remove_prefix(blank);
    }
    while (!line.empty()) {
        const std::size_t blank = blank_behind(line);
        if (blank == 0) break;
        line.remove_suffix(blank);
    }
    return line;
}

std::string lower_case(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

std::string extension_of(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    if (!extension.empty()) extension.erase(0, 1);
    return lower_case(extension);
}

std::string shown(std::string_view word) {
    constexpr int k_longest = 40;
    std::string text;
    int count = 0;
    for (std::size_t at = 0; at < word.size(); ++count) {
        if (count == k_longest) return text + "...";
        const std::size_t start = at;
        const std::int32_t code = next_code_point(word, at);
        if (code >= 0 && is_printable(code)) {
            text += word.substr(start, at - start);
        } else {
            text += '?';
        }
    }
    return text;
}

std::string with_plain_minus(std::string_view word) {
    // Minus, hyphens, dashes. People do not type small, full-width and superscript ones.
    for (const std::string_view minus :
         {"\u2212", "\u2010", "\u2011", "\u2012", "\u2013", "\u2014"}) {
        if (word.starts_with(minus)) return "-" + std::string(word.substr(minus.size()));
    }
    return std::string(word);
}

std::string not_a_number(std::string_view word) {
    std::string text = "'" + shown(word) + "' is not a finite number";
    const std::size_t comma = word.find(',');
    if (comma == std::string_view::npos) return text;
    const bool one = word.find(',', comma + 1) == std::string_view::npos;
    std::string pointed(word);
    pointed[comma] = '.';
    if (one && comma + 1 < word.size() && number_in(pointed))
        return text + ": it has a decimal comma; write a point (" + pointed + ")";
    return text + ": part numbers with blanks, not with commas";
}

std::optional<double> number_in(std::string_view word) {
    if (!word.empty() && static_cast<unsigned char>(word.front()) >= 0x80) {
        const std::string plain = with_plain_minus(trimmed(word));
        return plain == word ? std::nullopt : number_in(plain);
    }
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || word.empty()) return std::nullopt;
    if (error == std::errc::result_out_of_range) {
        // Too small a number is zero; too large is not a number.
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
    // Counted from the mantissa's first digit that is not zero.
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
    // Numbers that are single precision in disguise have its rounding however they are written.
    const bool is_single = any_single_ || all_near_single_;
    double rounding = largest_ * (is_single ? FLT_EPSILON / 2 : DBL_EPSILON / 2);
    if (count_ == 0) return rounding;
    // Digits tell about rounding only when most numbers use as many as any: `%.6f` ends all at one
    // place, `%.6e` and `%g` give most the same number. Files of short exact numbers (0.5, 2, 1.25)
    // do neither.
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
