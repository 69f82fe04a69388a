#pragma once
// The tests behind find_symmetry, of one fit. Private to the room.
//
// For each group Cn, Cnv of the stone's form the fitted planes' polar angle, azimuth and distance
// about an axis of their own (found along with it, so that no datum plays a part) are held against
// those of the nearest symmetric stone: the chi-square by which a symmetric fit is worse than a
// free one, in the linear model about the free fit (Wald 1943; Koch 1999, 3.4), with as many
// degrees of freedom as symmetry takes away from the shape: edges less orbits of edges (arXiv
// 1508.07855). Conditions that no reading tells anything of are not tested, and their number is
// given. How far from symmetric the stone is, is estimated tier by tier as a variance component of
// its own (restricted likelihood: Patterson & Thompson 1971), with the uncertainty that its
// information leaves it.

#include "fit/findings/findings.h"
#include "fit/model/fit_model.h"
#include "fit/model/options.h"
#include "fit/uncertainty/covariance.h"

namespace culet {

/// Says that the stone has a symmetry, which would only be found again: exact rotations and
/// mirrors, and those of all facets. One of some facets within a sigma is knowledge like any
/// reading.
bool declares_whole_symmetry(const Reading& reading);

/// `model` must hold no reading that declares its symmetry (`declares_whole_symmetry`): that would
/// be found again.
SymmetryReport symmetry_of(const FitModel& model, const Shape& shape, const Covariance& all,
                           const FitOptions& options);

}  // namespace culet
