#pragma once
// Reading numbers and words from the text of mesh and cut files, with line numbers for people.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace culet {

/// Lines of a text one after the other: without their ends (LF, CRLF or CR), counted from 1.
class LineReader {
public:
    explicit LineReader(std::string_view text) : text_(text) {}
    /// The next line; nothing at the end of the text.
    std::optional<std::string_view> next();
    long line() const { return line_; }
    std::size_t position() const { return position_; }

private:
    std::string_view text_;
    std::size_t position_ = 0;
    long line_ = 0;
};

/// The blank-separated words of a line. Blanks are those of ASCII and, in UTF-8, the no-break, thin
/// and wide ones (U+00A0, U+2007, U+2009, U+202F, U+3000) and a byte order mark.
std::vector<std::string_view> words_of(std::string_view line);

/// `line` without blanks at both ends, as above.
std::string_view trimmed(std::string_view line);

/// ASCII letters as small ones.
std::string lower_case(std::string text);

/// Of a file's name: the extension without its point, in small letters.
std::string extension_of(const std::filesystem::path& file);

/// As it may be shown to people: at most 40 characters of UTF-8; control characters, those that
/// reorder text, and bytes that are no UTF-8 as `?`.
std::string shown(std::string_view word);

/// The minus that typesetting and spreadsheets put before a number (U+2212, an en dash, ...) as
/// `-`.
std::string with_plain_minus(std::string_view word);

/// A finite decimal number that fills the word (`1`, `-2.5e-3`, `+4.`), whose minus may be a
/// typesetter's; nothing for any other word, for NaN and infinity, and beyond the range of doubles.
/// The locale plays no part.
std::optional<double> number_in(std::string_view word);
/// `'2,5' is not a finite number`, and what to do where commas are the cause.
std::string not_a_number(std::string_view word);
std::optional<std::int64_t> integer_in(std::string_view word);

/// How precisely a file states its coordinates, found from the digits that it spends on them.
class WrittenPrecision {
public:
    /// A coordinate as it stood in the text.
    void add(std::string_view word, double value);
    /// A coordinate stored in single or double precision.
    void add_single(double value);
    void add_double(double value);

    /// The largest error that rounding to that form has left in a coordinate.
    double rounding() const;

private:
    double largest_ = 0;
    bool any_single_ = false;
    bool all_near_single_ = true;
    long count_ = 0;
    std::vector<long> with_last_place_ = std::vector<long>(64, 0);  // 10^-i, i = index - 16
    std::vector<long> with_digits_ = std::vector<long>(33, 0);      // significant digits
};

}  // namespace culet
