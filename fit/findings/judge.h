#pragma once
// The verdict on a fit: its status and why, in one line. Private to the room.

#include "fit/findings/result.h"
#include "fit/solve/free_meets.h"
#include "fit/uncertainty/diagnostics.h"

namespace culet {

/// Sets `status` and `message` of a result that holds all else.
void judge(const FitModel& model, const Finished& finished, const Diagnosis& diagnosis,
           FitResult& result);

}  // namespace culet
