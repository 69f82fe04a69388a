#pragma once
// Whether a prior has anything to fill in.

#include <vector>

#include "fit/model/options.h"
#include "fit/readings/measurement.h"

namespace culet {

/// Next to nothing of the stone is left to the mesh, as far as one can tell before the fit: by the
/// number of readings (three quarters of the stone's freedoms), or else by the rank of the linear
/// model at the mesh (up to four open freedoms: a rough mesh shows some that are none).
bool readings_hold_all(const Stone& stone, const std::vector<Reading>& readings,
                       FitOptions options);

}  // namespace culet
