#pragma once
// Which symmetry the readings support, and how well they could have told otherwise.
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

#include <vector>

#include "fit/fit.h"

namespace culet {

/// Fits the stone without readings that declare its symmetry and asks; `options.start` may be the
/// stone as fitted with them. Throws InputError as `fit_stone` does.
SymmetryReport find_symmetry(const Stone& stone, const std::vector<Reading>& readings,
                             const FitOptions& options = {}, const Progress& progress = {});

}  // namespace culet
