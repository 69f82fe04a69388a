#pragma once
// Fills a result with what its numbers say: proportions, proposals, what is open, what to measure.

#include "fit/findings/result.h"
#include "fit/solve/free_meets.h"
#include "fit/uncertainty/diagnostics.h"

namespace culet {

void assess(const FitModel& model, const Finished& finished, const Diagnosis& diagnosis,
            FitResult& result);

}  // namespace culet
