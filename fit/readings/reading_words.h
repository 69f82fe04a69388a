#pragma once
// Words of a readings file: kinds, and the trade's names for them. Private to the room.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

struct KindWord {
    ReadingKind kind = ReadingKind::inclination;
    /// Words that mean more than a kind: a diameter or table without an azimuth, the angle of a
    /// side's mains, the tooth of an index wheel.
    enum class Trade {
        none,
        diameter,
        table,
        crown_angle,
        pavilion_angle,
        index
    } trade = Trade::none;
};

/// Ignores case; `_`, `-` and blanks are the same.
std::optional<KindWord> kind_word(std::string_view written);

/// The nearest word, or one with this beginning.
std::optional<std::string> near_kind_word(std::string_view written);

/// Splits at `/`, but not inside the brackets of mean(A/B), and trims blanks.
std::vector<std::string> split_names(std::string_view text);

/// Marks a row without a value as skipped if its kind needs one.
void mark_blank(WrittenReading& reading);

}  // namespace culet
