#pragma once
// Fills a result with what its numbers say: proportions, proposals, what is open, what to measure.

#include "fit/diagnostics.h"
#include "fit/finish.h"
#include "fit/fit.h"

namespace culet {

void assess(const System& system, const Finished& finished, const Diagnosis& diagnosis,
            FitResult& result);

}  // namespace culet
