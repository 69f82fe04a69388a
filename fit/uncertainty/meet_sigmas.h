#pragma once
// Estimates how far soft meets miss, together with the stone, if it is not given. Private to the
// room.

#include "fit/model/fit_model.h"
#include "fit/model/options.h"
#include "fit/solve/free_meets.h"
#include "stone/progress/progress.h"

namespace culet {

/// Sets the model's group sigmas and continues to the fit that they give. One start uses variance
/// components (Foerstner 1979: each group's uncertainty is the one that its residuals show). Those
/// equations may have several solutions: so the restricted likelihood (Patterson & Thompson 1971)
/// in the linear model about the first one is scanned from rounding error to a tenth of the half
/// diameter, each place where it is higher becomes a start, and the likeliest solution stays.
/// Returns how many different solutions were found.
int estimate_meet_sigmas(FitModel& model, Finished& finished, const FitOptions& options,
                         const Progress& progress);

}  // namespace culet
