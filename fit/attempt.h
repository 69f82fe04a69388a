#pragma once
// One fit of a problem as it stands. Private to the room.

#include "fit/hypotheses/problem.h"
#include "stone/progress/progress.h"

namespace culet {

/// Throws InputError as `fit_stone` does, Interrupted when progress says so.
Attempt attempt(const Problem& problem, const Progress& progress);

}  // namespace culet
