#pragma once
// A reading so wrong that no stone is found with it. Private to the room.

#include "fit/hypotheses/hypotheses.h"

namespace culet {

/// After a fit that found no stone: its first suspect with next to no weight. Not for relations and
/// exact readings.
std::optional<Problem> without_first_suspect(const Problem& given, const Attempt& first);

/// Holds if there is a stone then, chi-square falls to a hundredth, and the others contradict the
/// suspect.
Verdict judge_first_suspect(const Problem& given, const Attempt& first, const Problem& changed,
                            FitResult again);

}  // namespace culet
