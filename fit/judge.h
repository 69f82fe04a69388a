#pragma once
// The verdict on a fit: its status and why, in one line. Private to the room.

#include "fit/diagnostics.h"
#include "fit/finish.h"
#include "fit/fit.h"

namespace culet {

/// Sets `status` and `message` of a result that holds all else.
void judge(const System& system, const Finished& finished, const Diagnosis& diagnosis,
           FitResult& result);

}  // namespace culet
