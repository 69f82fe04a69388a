#pragma once
// Which single further reading would help most.

#include <memory>
#include <vector>

#include "fit/findings/findings.h"
#include "fit/model/fit_model.h"
#include "fit/uncertainty/covariance.h"

namespace culet {

/// The best few, each of another tier or kind, best first. A reading of sigma s of a quantity c
/// takes |C c|^2 / (s^2 + c'Cc) off the total variance of all facets' tilts (radians) and offsets
/// (half diameters), where C holds the mesh's own trust for what is open. The candidates: every
/// inclination and azimuth, edge lengths, widths all around, depth, table widths and weight (or
/// volume), as far as the tools are at hand; each with the median sigma of the readings like it.
std::vector<NextReading> next_readings(const FitModel& model, const Shape& shape,
                                       const std::shared_ptr<const Outline>& outline,
                                       const Covariance& covariance);

}  // namespace culet
