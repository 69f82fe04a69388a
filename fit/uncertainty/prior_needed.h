#pragma once
// Decides whether a prior has anything to fill in.

#include <vector>

#include "fit/model/options.h"
#include "fit/readings/measurement.h"

namespace culet {

/// True if the readings leave next to nothing to the mesh, as far as one can tell before the fit:
/// by their number (three quarters of the stone's degrees of freedom), or by the rank of the linear
/// model at the mesh (up to four undetermined directions: a rough mesh shows some that are none).
bool readings_hold_all(const Stone& stone, const std::vector<Reading>& readings,
                       FitOptions options);

}  // namespace culet
