#pragma once
// Fits that resist wrong readings: iteratively reweighted least squares.

#include <vector>

#include "fit/starts/multistart.h"

namespace culet {

/// Weight of a residual of `z` sigmas. Huber (1964): 1 within 1.345, 1.345/|z| beyond. Cauchy: 1/(1
/// + (z/2.385)^2). Both lose 5 % of efficiency on normal errors (Holland & Welsch 1977). No loss:
/// 1.
double robust_weight(Loss loss, double z);

/// Fits again with each reading's variance divided by its weight, until no weight changes by more
/// than 1 %. Returns the weights, one a reading, and leaves the weighted sigmas in `model`. Exact
/// readings and relations keep theirs.
std::vector<double> reweight(FitModel& model, Candidate& candidate, Loss loss, int iterations);

}  // namespace culet
