#pragma once
// How far soft meets miss, where nobody says: estimated along with the stone. Private to the room.

#include "fit/model/fit_model.h"
#include "fit/model/options.h"
#include "fit/solve/free_meets.h"
#include "stone/progress/progress.h"

namespace culet {

/// Sets the model's group sigmas and goes on to the fit that they give. From one start by
/// variance components (Foerstner 1979: each group's uncertainty is the one that its residuals
/// show). Those equations may have several solutions: in the linear model about the first one the
/// restricted likelihood (Patterson & Thompson 1971) is scanned over all sizes from rounding to a
/// tenth of the half diameter, a start is made wherever it is higher, and the likeliest end stays.
/// Returns how many different ends were found.
int estimate_meet_sigmas(FitModel& model, Finished& finished, const FitOptions& options,
                         const Progress& progress);

}  // namespace culet
