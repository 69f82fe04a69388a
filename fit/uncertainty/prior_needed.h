#pragma once
// Decides whether a prior has anything to fill in.

#include <vector>

#include "fit/model/options.h"
#include "fit/readings/measurement.h"

namespace culet {

/// True if the readings leave next to nothing of the stone to the mesh. Decided before the fit: by
/// the number of readings (three quarters of the stone's degrees of freedom), or else by the rank
/// of the linear model at the mesh (up to four undetermined directions: a rough mesh shows some
/// that are not).
bool readings_hold_all(const Stone& stone, const std::vector<Reading>& readings,
                       FitOptions options);

}  // namespace culet
