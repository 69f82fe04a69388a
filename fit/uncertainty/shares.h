#pragma once
// Beside a prior: what part of each facet was read. Private to the room.

#include "fit/uncertainty/covariance.h"
#include "fit/uncertainty/diagnostics.h"

namespace culet {

/// Fills in FacetSigma::read: 1 less the variance over that of the prior alone, meets, symmetry and
/// exact readings taken for granted. `middle`: offsets count from there.
void find_parts_read(const Shape& shape, const Covariance& covariance, const Vec3& middle,
                     Diagnosis& diagnosis);

}  // namespace culet
