#pragma once
// What a fit came to, in the words of its result: solid, facets, readings, meets. Private to the
// room.

#include <vector>

#include "fit/findings/result.h"
#include "fit/model/fit_model.h"
#include "fit/uncertainty/diagnostics.h"

namespace culet {

/// The solid that is written (corners from the fit, or what the planes enclose), its faults, every
/// facet and every reading (`as_read`: with the sigmas that were given). `weights` of the readings
/// under a robust loss, or none.
void fill_in(const FitModel& model, const std::vector<Reading>& as_read, const Shape& shape,
             const Diagnosis& diagnosis, const Frame::Pose& pose,
             const std::vector<double>& weights, FitResult& result);

/// A reading as it was taken; what the fit makes of it is still open.
FittedReading as_taken(const Reading& reading);

/// The result of a fit without some readings, with these in their places again, marked as left out.
void put_left_out(const std::vector<Reading>& readings, const std::vector<std::size_t>& left_out,
                  FitResult& result);

}  // namespace culet
