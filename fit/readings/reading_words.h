#pragma once
// The words of a readings file: kinds, and the trade's names for them. Private to the room.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// A kind as written.
struct KindWord {
    ReadingKind kind = ReadingKind::inclination;
    /// Words that are not just another name of a kind: a diameter or a table without an azimuth,
    /// the angle of a side's mains, the tooth of an index wheel.
    enum class Trade {
        none,
        diameter,
        table,
        crown_angle,
        pavilion_angle,
        index
    } trade = Trade::none;
};

/// Finds a kind. Upper and lower case are the same, and so are `_`, `-` and blanks.
std::optional<KindWord> kind_word(std::string_view written);

/// Suggests a word for an unknown one: the nearest, or one with this beginning.
std::optional<std::string> near_kind_word(std::string_view written);

/// Splits names at `/`, but not inside the brackets of mean(A/B), and trims blanks.
std::vector<std::string> split_names(std::string_view text);

/// Marks a row of a form as skipped if it has no value and its kind needs one.
void mark_blank(WrittenReading& reading);

}  // namespace culet
