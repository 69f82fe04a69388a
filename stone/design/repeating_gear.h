#pragma once
// The gear of a design that does not state it.

#include <optional>

#include "stone/design/design.h"

namespace culet {

/// GemCad's own.
inline constexpr double k_usual_gear = 96;

/// The one other gear of the trade on which the tiers repeat about the axis as the design's
/// symmetry asks (where it states none, by any part of a turn from a half to a sixteenth) and no
/// index is beyond it. Nothing where they do on the usual one, on none or on several.
std::optional<double> repeating_gear(const Design& design);

}  // namespace culet
