#pragma once
// Writes a fit and its findings into a result, and sets the verdict. Private to the room.

#include "fit/findings/result.h"
#include "fit/model/fit_model.h"
#include "fit/solve/active_set.h"
#include "fit/solve/free_meets.h"
#include "fit/uncertainty/diagnostics.h"

namespace culet {

/// Fills in solid, faults, facets and readings. `as_read` has the readings with their given sigmas;
/// `weights` are those of a robust loss, or empty.
void fill_in(const FitModel& model, const std::vector<Reading>& as_read, const Shape& shape,
             const Diagnosis& diagnosis, const Frame::Pose& pose,
             const std::vector<double>& weights, FitResult& result);

/// The readings' azimuth of a direction in the fit's frame; 0 if it has none.
double outside_azimuth(const Vec3& inside, const Frame::Pose& pose);

/// Adds proposals, proportions, undetermined parameters and further readings; if asked for, also
/// axis, tiers, meets, edges and facets. Facets, readings and tests must be there already. `held`:
/// corners (a point below a facet) that are active constraints.
void describe_findings(const FitModel& model, const Finished& finished,
                       const std::vector<ActiveCorner>& held, const Diagnosis& diagnosis,
                       const Frame::Pose& pose, FitResult& result);

/// Sets `status` and `message` of a result that is complete otherwise.
void judge(const FitModel& model, const Finished& finished, const Diagnosis& diagnosis,
           FitResult& result);

}  // namespace culet
