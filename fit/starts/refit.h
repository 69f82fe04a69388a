#pragma once
// Fitting again from a stone that was fitted before: no search for a start.

#include <optional>

#include "fit/starts/multistart.h"

namespace culet {

/// The last stage alone, from a shape that is nearly right.
Candidate finish_from(const FitModel& model, const Shape& shape, int iterations);

/// Likewise from the end of an earlier fit to readings most of which are the same: where they agree
/// well, they mean what they meant then, and no other turns and signs are looked for.
Candidate refit_from(const FitModel& model, const Shape& shape, int iterations);

/// The shape of a solid with the mesh's facets, such as an earlier result: upright, in the fit's
/// scale, turned as the readings' azimuths (or the mesh) say. Nothing when it lacks a facet.
std::optional<Shape> shape_of(const FitModel& model, const Solid& solid);

}  // namespace culet
