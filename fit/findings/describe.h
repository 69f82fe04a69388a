#pragma once
// Puts what a fit came to, and what was found out about the stone, into its result, and judges it.
// Private to the room.

#include "fit/findings/result.h"
#include "fit/model/fit_model.h"
#include "fit/solve/active_set.h"
#include "fit/solve/free_meets.h"
#include "fit/uncertainty/diagnostics.h"

namespace culet {

/// The solid that is written (corners from the fit, or what the planes enclose), its faults, every
/// facet and every reading (`as_read`: with the sigmas that were given). `weights` of the readings
/// under a robust loss, or none.
void fill_in(const FitModel& model, const std::vector<Reading>& as_read, const Shape& shape,
             const Diagnosis& diagnosis, const Frame::Pose& pose,
             const std::vector<double>& weights, FitResult& result);

/// Of a direction inside the fit; 0 where it has none.
double outside_azimuth(const Vec3& inside, const Frame::Pose& pose);

/// Proposals, proportions, what is open, what to measure; own axis, tiers, meets, edges and facets,
/// where findings are asked for. `result` holds facets, readings and tests already.
/// `held` are corners (point below facet) that the fit had to hold down.
void describe_findings(const FitModel& model, const Finished& finished,
                       const std::vector<ActiveCorner>& held, const Diagnosis& diagnosis,
                       const Frame::Pose& pose, FitResult& result);

/// The verdict: sets `status` and `message` of a result that holds all else.
void judge(const FitModel& model, const Finished& finished, const Diagnosis& diagnosis,
           FitResult& result);

}  // namespace culet
