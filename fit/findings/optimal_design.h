#pragma once
// Finds the single further readings that would help most.

#include <memory>
#include <vector>

#include "fit/findings/findings.h"
#include "fit/model/fit_model.h"
#include "fit/uncertainty/covariance.h"

namespace culet {

/// Returns the best few, each of another tier or kind, the best first. A reading of sigma s of a
/// quantity c reduces the total variance of all facets' tilts (radians) and offsets (half
/// diameters) by |C c|^2 / (s^2 + c'Cc); in C, undetermined directions have the mesh's own
/// uncertainty. Candidates: every inclination and azimuth, edge lengths, widths all around, depth,
/// table widths and weight (or volume), if the tools are at hand. Each has the median sigma of
/// similar readings.
std::vector<NextReading> next_readings(const FitModel& model, const Shape& shape,
                                       const std::shared_ptr<const Outline>& outline,
                                       const Covariance& covariance);

}  // namespace culet
