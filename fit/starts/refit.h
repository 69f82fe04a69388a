#pragma once
// Fits again from a stone that was fitted before, without a search for a start.

#include <optional>

#include "fit/starts/multistart.h"

namespace culet {

/// Runs the last stage alone, from a shape that is nearly right.
Candidate finish_from(const FitModel& model, const Shape& shape, int iterations);

/// The same, from the minimum of an earlier fit to mostly the same readings. Where these agree
/// well, their active branches stay as they were, and no other signs are tried.
Candidate refit_from(const FitModel& model, const Shape& shape, int iterations);

/// Returns the shape of a solid with the mesh's facets, such as an earlier result: upright, in the
/// fit's scale, turned to the azimuths of the readings (or the mesh). Nothing when a facet is
/// missing.
std::optional<Shape> shape_of(const FitModel& model, const Solid& solid);

}  // namespace culet
