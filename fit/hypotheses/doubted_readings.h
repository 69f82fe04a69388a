#pragma once
// Readings that the first check doubts. They may be slips of the pen, or the mesh may be rough: the
// fit decides. Private to the room.

#include "fit/hypotheses/hypotheses.h"

namespace culet {

/// The problem without the readings that the first check doubts. Readings that determine the stone
/// check each other better, so there this applies only if no stone was found, or if they contradict
/// each other and do not accuse one of the doubted alone (a gross error bends the stone and accuses
/// its neighbours).
std::optional<Problem> without_doubted(const Problem& given, const Attempt& first);

/// Holds if the first fit found no stone and this one does, or if chi-square falls by more than as
/// many rows of readings explain by chance: from fit to fit, or at the first one's sigmas. If the
/// readings determine the stone, doubted readings that its fit does not contradict are restored
/// first.
Verdict judge_doubted(const Problem& given, const Attempt& first, const Problem& changed,
                      FitResult again);

}  // namespace culet
