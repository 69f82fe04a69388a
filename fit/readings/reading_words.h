#pragma once
// The words of a readings file: kinds and what the trade calls them.
// Private to the room.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// A kind as it was written.
struct KindWord {
    ReadingKind kind = ReadingKind::inclination;
    /// Words that mean more than another name: a diameter or a table without an azimuth, the angle
    /// of a side's mains, the tooth of an index wheel.
    enum class Trade {
        none,
        diameter,
        table,
        crown_angle,
        pavilion_angle,
        index
    } trade = Trade::none;
};

/// Large and small letters are one, and so are `_`, `-` and blanks.
std::optional<KindWord> kind_word(std::string_view written);

/// The word that was meant by one that is none: the nearest, or the one that begins so.
std::optional<std::string> near_kind_word(std::string_view written);

/// Names split by `/`, but not inside the brackets of mean(A/B). Blanks at the ends go.
std::vector<std::string> split_names(std::string_view text);

/// Marks a row of a form that was not filled in: it has no value, and its kind needs one.
void mark_blank(WrittenReading& reading);

}  // namespace culet
