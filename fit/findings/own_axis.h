#pragma once
// The stone's own best axis. A table that was polished 0.8 degrees askew turns equal pavilion
// facets into unequal ones as long as their angles are counted from it; counted from the axis about
// which the tiers are most alike they are equal again. Private to the room.

#include <vector>

#include "fit/findings/findings.h"
#include "fit/uncertainty/covariance.h"
#include "stone/solid/axis_groups.h"

namespace culet {

/// Orbits of two facets and more of the form's symmetry, as far as the shape comes near to it
/// (within 5 % of the half diameter), the girdle's included.
std::vector<Tier> tiers_of(const FitModel& model, const Shape& shape, const AxisGroup& group);

/// The symmetry of the form that the shape comes near to.
AxisGroup form_group(const FitModel& model, const Shape& shape);

/// In the frame and scale of the fit. The direction a that minimises
///     sum over tiers w_t / sin^2(i_t) sum over facets (n_k . a - mean of n . a)^2,
/// the least eigenvector of a 3 x 3 matrix; w_t = 1 / variance of the tier's inclinations about
/// it, by repeated weighting, so that a tier that is askew (the stars about a tilted table) does
/// not pull at it. With fewer than two turns in the form's symmetry: the direction least along the
/// girdle's normals. `covariance` may be null: sigmas are then infinite.
struct AxisEstimate {
    OwnAxis axis;                        ///< up, where it is not known
    Vec3 east{1, 0, 0}, north{0, 1, 0};  ///< across it; azimuths begin where those about up do
    std::vector<Quantity> across;        ///< its components along them; none: not known
};
AxisEstimate own_axis(const FitModel& model, const Shape& shape, const std::vector<Tier>& tiers,
                      const Covariance* covariance);

}  // namespace culet
