#pragma once
// All azimuths count from another direction than the widths. Private to the room.

#include "fit/hypotheses/hypotheses.h"

namespace culet {

/// Turns all azimuths back if they are said to count from the mesh but are turned by a multiple of
/// 15 degrees, and the readings contradict each other.
std::optional<Problem> azimuths_turned_back(const Problem& given, const Attempt& first);

/// Holds if that removes most of chi-square. The azimuths stay as read in the result, which accuses
/// none of them, but says first what they share.
Verdict judge_turned_azimuths(const Problem& given, const Attempt& first, const Problem& changed,
                              FitResult again);

}  // namespace culet
