#pragma once
// With a prior: the part of each facet that was read. Private to the room.

#include "fit/uncertainty/covariance.h"
#include "fit/uncertainty/diagnostics.h"

namespace culet {

/// Fills in FacetSigma::read: 1 - variance / variance of the prior with meets, symmetry and exact
/// readings. Offsets count from `middle`.
void find_parts_read(const Shape& shape, const Covariance& covariance, const Vec3& middle,
                     Diagnosis& diagnosis);

}  // namespace culet
