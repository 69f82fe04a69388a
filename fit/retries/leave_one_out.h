#pragma once
// A reading so wrong that no stone is found with it. Private to the room.

#include <functional>
#include <optional>
#include <vector>

#include "fit/findings/result.h"

namespace culet {

/// Of a fit that found no stone and suspects some reading: the first of the suspects is asked for
/// next to nothing, and fitted again by `fit_again`. The result with that reading accused, if then
/// there is a stone, chi-square falls to a hundredth, and the others deny the reading; else
/// nothing. Not for relations and exact readings.
std::optional<FitResult> fit_leaving_one_out(
    const FitResult& result, const std::vector<Reading>& readings,
    const std::function<FitResult(const std::vector<Reading>&)>& fit_again);

}  // namespace culet
