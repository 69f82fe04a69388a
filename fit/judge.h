#pragma once
// The verdict on a fit: its status and why, in one line. Private to the room.

#include "fit/diagnostics.h"
#include "fit/finish.h"
#include "fit/fit.h"

namespace culet {

/// What is left of hard equations after the last stage is rounding; an exact reading that misses by
/// more than this part of the half diameter contradicts another.
inline constexpr double k_hard_limit = 1e-9;

/// Sets `status` and `message` of a result that holds all else.
void judge(const System& system, const Finished& finished, const Diagnosis& diagnosis,
           FitResult& result);

}  // namespace culet
