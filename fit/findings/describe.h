#pragma once
// Puts what was found out about the stone into the result of its fit. Private to the room.

#include "fit/findings/result.h"
#include "fit/model/fit_model.h"
#include "fit/solve/active_set.h"
#include "fit/solve/free_meets.h"
#include "fit/uncertainty/diagnostics.h"

namespace culet {

/// Own axis, tiers, meets, edges and facets. `result` holds facets, readings and tests already.
/// `held` are corners (point below facet) that the fit had to hold down.
void describe_findings(const FitModel& model, const Finished& finished,
                       const std::vector<ActiveCorner>& held, const Diagnosis& diagnosis,
                       const Frame::Pose& pose, FitResult& result);

}  // namespace culet
