#pragma once
// The stone's own best axis. From a table polished 0.8 degrees askew, equal pavilion facets read
// unequal angles; about this axis they are equal again. Private to the room.

#include <vector>

#include "fit/findings/findings.h"
#include "fit/uncertainty/covariance.h"
#include "stone/solid/axis_groups.h"

namespace culet {

/// Orbits of two or more facets, the girdle's included, under the form's symmetry.
std::vector<Tier> tiers_of(const FitModel& model, const Shape& shape, const AxisGroup& group);

/// The symmetry of the form, if the shape is near to it (within 5 % of the half diameter).
AxisGroup form_group(const FitModel& model, const Shape& shape);

/// In the frame and scale of the fit. The direction a minimises
///     sum over tiers w_t / sin^2(i_t) sum over facets (n_k . a - mean of n . a)^2
/// (smallest eigenvalue of a 3 x 3 matrix). w_t = 1 / variance of the tier's inclinations about a,
/// by iterative reweighting, so that a tier that is askew (the stars about a tilted table) does not
/// pull. Without at least two-fold rotation in the form, a is the direction with the smallest
/// components along the girdle's normals. If `covariance` is null, sigmas are infinite.
struct AxisEstimate {
    OwnAxis axis;                        ///< up, if the axis is not known
    Vec3 east{1, 0, 0}, north{0, 1, 0};  ///< across the axis; azimuths begin where those about up
                                         ///< do
    std::vector<Quantity> across;        ///< the axis's components along them; empty: not known
};
AxisEstimate own_axis(const FitModel& model, const Shape& shape, const std::vector<Tier>& tiers,
                      const Covariance* covariance);

}  // namespace culet
