#pragma once
// Writes the parts of a result: solid, facets, readings, meets. Private to the room.

#include <vector>

#include "fit/findings/result.h"
#include "fit/model/fit_model.h"
#include "fit/uncertainty/diagnostics.h"

namespace culet {

/// As in describe.h.
void fill_in(const FitModel& model, const std::vector<Reading>& as_read, const Shape& shape,
             const Diagnosis& diagnosis, const Frame::Pose& pose,
             const std::vector<double>& weights, FitResult& result);

/// As in blunder.h.
FittedReading as_taken(const Reading& reading);

/// As in blunder.h.
void put_left_out(const std::vector<Reading>& readings, const std::vector<std::size_t>& left_out,
                  FitResult& result);

}  // namespace culet
