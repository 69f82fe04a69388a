#pragma once
// Readings that the first check doubts: slips of the pen, or good ones beside a rough mesh. The fit
// decides. Private to the room.

#include "fit/hypotheses/hypotheses.h"

namespace culet {

/// The problem without doubted readings. If the readings determine the stone they check each other
/// better: then only if no stone was found, or if they contradict each other without accusing one
/// of the doubted alone (a gross error bends the stone and accuses its neighbours).
std::optional<Problem> without_doubted(const Problem& given, const Attempt& first);

/// Holds if the first fit found no stone and this one does, or if chi-square falls by more than as
/// many rows explain by chance: from fit to fit, or at the first one's sigmas. If the readings
/// determine the stone, those that its fit does not contradict are restored first.
Verdict judge_doubted(const Problem& given, const Attempt& first, const Problem& changed,
                      FitResult again);

}  // namespace culet
