#pragma once
// Finds the single further readings that would help most.

#include <memory>
#include <vector>

#include "fit/findings/findings.h"
#include "fit/model/fit_model.h"
#include "fit/uncertainty/covariance.h"

namespace culet {

/// Returns the best few, each of another tier or kind, the best first. A reading of sigma s of a
/// quantity c reduces the total variance of the facets' tilts (radians) and offsets (half
/// diameters) by |C c|^2 / (s^2 + c'Cc); C has the mesh's own uncertainty in undetermined
/// directions. Candidates, as far as tools are at hand: inclinations, azimuths, edges, widths all
/// around, depth, table widths, weight (or volume); each with the median sigma of similar readings.
std::vector<NextReading> next_readings(const FitModel& model, const Shape& shape,
                                       const std::shared_ptr<const Outline>& outline,
                                       const Covariance& covariance);

}  // namespace culet
