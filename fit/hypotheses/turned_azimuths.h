#pragma once
// Azimuths that all count from another direction than the widths do. Private to the room.

#include "fit/hypotheses/hypotheses.h"

namespace culet {

/// Where azimuths are said to count from the mesh and stand turned by a multiple of 15 degrees, and
/// the readings contradict each other for it: all azimuths turned back.
std::optional<Problem> azimuths_turned_back(const Problem& given, const Attempt& first);

/// Holds if that takes most of chi-square away. The result's azimuths are as they were read; it
/// accuses none of them, but says what all of them share, first.
Verdict judge_turned_azimuths(const Problem& given, const Attempt& first, const Problem& changed,
                              FitResult again);

}  // namespace culet
