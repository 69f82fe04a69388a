#pragma once
// Readings that the first check doubts: a slip of the pen, or a rough mesh that doubts what is
// right. The fit decides. Private to the room.

#include "fit/hypotheses/hypotheses.h"

namespace culet {

/// The problem without the readings that the first check doubts, where it is asked for. Readings
/// that hold the stone check each other, and better: there only if no stone was found, or if they
/// contradict each other and do not accuse one of the doubted alone (a gross error bends the stone,
/// and accuses its neighbours).
std::optional<Problem> without_doubted(const Problem& given, const Attempt& first);

/// Holds where the first fit found no stone and this one does, or where chi-square falls by more
/// than as many rows of readings bring by chance: from fit to fit, or at the first one's sigmas.
/// Where the readings hold the stone, what its fit does not deny goes back first.
Verdict judge_doubted(const Problem& given, const Attempt& first, const Problem& changed,
                      FitResult again);

}  // namespace culet
