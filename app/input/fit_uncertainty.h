#pragma once
// How sure a fit is of its facets, for drawing stones.

#include <filesystem>

#include "fit/findings/result.h"
#include "render/uncertainty/drawn_stones.h"
#include "stone/stone.h"

namespace culet {

/// Of the facets of `result.solid`, in its order and unit, with their covariance where it is known.
StoneUncertainty uncertainty_of(const FitResult& result);

/// Of the stone's facets by the report of their fit, in the stone's unit; with its
/// `facet_covariance` (rows of three a facet in the order of its `facets`: inclination, azimuth in
/// degrees, offset) where it has one. Throws InputError where it is no report, or another stone's.
StoneUncertainty uncertainty_in(const std::filesystem::path& report, const Stone& stone);

}  // namespace culet
