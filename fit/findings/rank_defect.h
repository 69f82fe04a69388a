#pragma once
// What no reading holds, in words.

#include <string>
#include <vector>

#include "fit/findings/result.h"
#include "fit/uncertainty/covariance.h"

namespace culet {

/// One sentence a tier and kind of freedom: `nothing measured fixes the azimuth of crown facet S3`.
/// Tiers are facets whose names differ only in their number. Where a tier's open parameters are
/// fewer than its facets, the sentence says whether they move together or against each other.
std::vector<std::string> describe_open_freedoms(const FitModel& model, const Shape& shape,
                                                const Covariance& covariance,
                                                const std::vector<Undetermined>& undetermined);

}  // namespace culet
