#pragma once
// The uncertainty of a fit's facets, for drawing stones at random.

#include <filesystem>

#include "fit/findings/result.h"
#include "render/uncertainty/drawn_stones.h"
#include "stone/stone.h"

namespace culet {

/// Keeps the order and unit of `result.solid`; adds the covariance if known.
StoneUncertainty uncertainty_of(const FitResult& result);

/// Reads a fit's report; the result is in the stone's unit. Uses `facet_covariance` if present
/// (three rows per facet, in the order of its `facets`: inclination and azimuth in degrees,
/// offset). Throws InputError if it is not a report, or another stone's.
StoneUncertainty uncertainty_in(const std::filesystem::path& report, const Stone& stone);

}  // namespace culet
