#pragma once
// Reads numbers and words from the text of mesh and cut files, with line numbers for messages.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace culet {

/// The lines of a text without their ends (LF, CRLF or CR), counted from 1.
class LineReader {
public:
    explicit LineReader(std::string_view text) : text_(text) {}
    std::optional<std::string_view> next();
    long line() const { return line_; }
    std::size_t position() const { return position_; }

private:
    std::string_view text_;
    std::size_t position_ = 0;
    long line_ = 0;
};

/// Words are separated by blanks: those of ASCII, U+00A0, U+2007, U+2009, U+202F, U+3000 (no-break,
/// thin and wide ones) and a byte order mark.
std::vector<std::string_view> words_of(std::string_view line);

/// Removes the same blanks at both ends.
std::string_view trimmed(std::string_view line);

/// Converts ASCII letters only.
std::string lower_case(std::string text);

/// The extension without its point, in lower case.
std::string extension_of(const std::filesystem::path& file);

/// Makes a word safe to show: at most 40 characters of UTF-8; control characters, those that
/// reorder text, and invalid bytes become `?`.
std::string shown(std::string_view word);

/// Replaces a typographic minus (U+2212, an en dash, ...) before a number by `-`.
std::string with_plain_minus(std::string_view word);

/// The whole word as a finite decimal number (`1`, `-2.5e-3`, `+4.`; typographic minus allowed), in
/// any locale. Nothing for other words, NaN, infinity, and beyond the range of doubles.
std::optional<double> number_in(std::string_view word);
/// `'2,5' is not a finite number`, with advice where commas are the cause.
std::string not_a_number(std::string_view word);
std::optional<std::int64_t> integer_in(std::string_view word);

/// Estimates how precisely a file states its coordinates, from their digits.
class WrittenPrecision {
public:
    /// A coordinate as written in the text.
    void add(std::string_view word, double value);
    void add_single(double value);
    void add_double(double value);

    /// Largest rounding error of a coordinate.
    double rounding() const;

private:
    double largest_ = 0;
    bool any_single_ = false;
    bool all_near_single_ = true;
    long count_ = 0;
    std::vector<long> with_last_place_ = std::vector<long>(64, 0);  // 10^-i, i = index - 16
    std::vector<long> with_digits_ = std::vector<long>(33, 0);      // by number of significant
                                                                    // digits
};

}  // namespace culet
