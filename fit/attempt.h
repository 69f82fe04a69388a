#pragma once
// Fits one problem as it stands, without trying hypotheses about its readings. Private to the room.

#include "fit/hypotheses/problem.h"
#include "stone/progress/progress.h"

namespace culet {

/// Throws InputError as `fit_stone` does, Interrupted when progress says so.
Attempt attempt(const Problem& problem, const Progress& progress);

}  // namespace culet
