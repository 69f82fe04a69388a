#pragma once
// Readings that the first check doubts: a slip of the pen, or a rough mesh that doubts what is
// right. The fit decides. Private to the room.

#include "fit/hypotheses/hypotheses.h"

namespace culet {

/// The problem without the readings that the first check doubts, where it is asked for and the
/// readings do not hold the stone: those check each other, and better.
std::optional<Problem> without_doubted(const Problem& given, const Attempt& first);

/// Holds where the first fit found no stone and this one does, or where chi-square falls by more
/// than as many rows of readings bring by chance: from fit to fit, or at the first one's sigmas.
Verdict judge_doubted(const Problem& given, const Attempt& first, const Problem& changed,
                      FitResult again);

}  // namespace culet
