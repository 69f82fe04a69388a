#pragma once
// A reading so wrong that no stone is found with it. Private to the room.

#include "fit/hypotheses/hypotheses.h"

namespace culet {

/// Of a fit that found no stone: the first of its suspects is asked for next to nothing. Not for
/// relations and exact readings.
std::optional<Problem> without_first_suspect(const Problem& given, const Attempt& first);

/// Holds if then there is a stone, chi-square falls to a hundredth, and the others deny the
/// reading.
Verdict judge_first_suspect(const Problem& given, const Attempt& first, const Problem& changed,
                            FitResult again);

}  // namespace culet
