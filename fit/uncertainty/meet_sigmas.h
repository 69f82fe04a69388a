#pragma once
// Estimates how far soft meets miss. Private to the room.

#include "fit/model/fit_model.h"
#include "fit/model/options.h"
#include "fit/solve/free_meets.h"
#include "stone/progress/progress.h"

namespace culet {

/// Sets the model's group sigmas and fits with them, first by variance components (Foerstner 1979:
/// each group's uncertainty is the one that its residuals show). As there may be several solutions,
/// the restricted likelihood (Patterson & Thompson 1971) in the linear model is scanned from
/// rounding error to a tenth of the half diameter; each higher place becomes a start, and the
/// likeliest solution stays. Returns how many different solutions were found.
int estimate_meet_sigmas(FitModel& model, Finished& finished, const FitOptions& options,
                         const Progress& progress);

}  // namespace culet
