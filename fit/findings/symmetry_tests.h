#pragma once
// The tests behind find_symmetry, for one fit. Private to the room.
//
// For each group Cn, Cnv of the form, the planes' polar angle, azimuth and distance are compared
// with those of the nearest symmetric stone, about an axis that is estimated too, so no datum
// matters. The statistic is the rise of chi-square in a symmetric fit, in the linear model about
// the free fit (Wald 1943; Koch 1999, 3.4), with as many degrees of freedom as symmetry removes
// from the shape: edges less orbits of edges (arXiv 1508.07855). Conditions that the readings do
// not determine are counted, not tested.
// The deviation from symmetry is estimated tier by tier as a variance component (restricted
// likelihood: Patterson & Thompson 1971), with its uncertainty from the information matrix.

#include "fit/findings/findings.h"
#include "fit/model/fit_model.h"
#include "fit/model/options.h"
#include "fit/uncertainty/covariance.h"

namespace culet {

/// True for symmetries of the whole stone, which the tests would only find again: exact rotations
/// and mirrors, and those of all facets. One of some facets within a sigma is like any reading.
bool declares_whole_symmetry(const Reading& reading);

/// `model` must hold no reading for which `declares_whole_symmetry` is true.
SymmetryReport symmetry_of(const FitModel& model, const Shape& shape, const Covariance& all,
                           const FitOptions& options);

}  // namespace culet
