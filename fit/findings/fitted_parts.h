#pragma once
// Writes the parts of a result: solid, facets, readings, meets. Private to the room.

#include <vector>

#include "fit/findings/result.h"
#include "fit/model/fit_model.h"
#include "fit/uncertainty/diagnostics.h"

namespace culet {

/// Fills in the solid (corners from the fit, or the intersection of the planes), its faults, all
/// facets and all readings. `as_read` has the readings with their given sigmas; `weights` are those
/// of a robust loss, or empty.
void fill_in(const FitModel& model, const std::vector<Reading>& as_read, const Shape& shape,
             const Diagnosis& diagnosis, const Frame::Pose& pose,
             const std::vector<double>& weights, FitResult& result);

/// A reading as it was taken, without anything from the fit.
FittedReading as_taken(const Reading& reading);

/// Restores these readings to the result of a fit without them, marked as left out.
void put_left_out(const std::vector<Reading>& readings, const std::vector<std::size_t>& left_out,
                  FitResult& result);

}  // namespace culet
