#pragma once
// Numbers as people write them, with a decimal comma or a unit.

#include <string>
#include <string_view>

namespace culet {

/// A unit written beside a number.
struct WrittenUnit {
    enum class Of { none, length, angle, weight, volume, percent, teeth } of = Of::none;
    double factor = 1;  ///< to mm, degrees, carat or mm3; for a tooth, the number of teeth of its
                        ///< wheel
    std::string word;   ///< as written
};

/// A number with an optional unit: 34.5; 33,8; 6.52mm; 33.8 deg; 33 degrees and 48 minutes by their
/// signs; 12 of 96 or 12/96, a tooth of an index wheel. `problem` says what is wrong; empty:
/// nothing.
struct WrittenNumber {
    double value = 0;
    WrittenUnit unit;
    std::string problem;
};
/// `comma_separates`: commas separate the file's fields, so 1,234 may be a thousand.
WrittenNumber written_number(std::string_view text, bool comma_separates);

}  // namespace culet
