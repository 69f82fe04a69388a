#pragma once
// Guesses the gear or the symmetry of a design that does not state it.

#include <optional>

#include "stone/design/design.h"

namespace culet {

/// GemCad's default.
inline constexpr double k_usual_gear = 96;

/// The one other gear of the trade on which the tiers repeat as the design's symmetry asks, with no
/// index beyond it. Without a stated symmetry any turn from a half to a sixteenth counts. Nothing
/// where the tiers repeat on the usual gear, on none, or on several.
std::optional<double> repeating_gear(const Design& design);

/// Sets the design's symmetry to that of its index settings: the most folds, and whether a
/// mirroring maps each tier onto itself. For gears that count forward, and indices up to the gear.
void state_symmetry(Design& design);

}  // namespace culet
