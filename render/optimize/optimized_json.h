#pragma once
// What an optimisation changed, as JSON (docs/optimize.md) and in the words of a cutting sheet.

#include <string>
#include <vector>

#include "render/optimize/optimize.h"
#include "stone/design/design.h"

namespace culet {

/// The titles of the design's tiers that hold the facets of `tier`: "P1", "C1 C2".
std::string tier_words(const Solid& solid, const Design& design, const FacetTier& tier);

/// Merits before and after, and the tiers' angles; `design` as of `result.start`. `objective`: the
/// merit's weights as words.
std::string optimized_json(const Optimized& result, const Design& design,
                           const OptimizeOptions& options, const std::string& objective);

}  // namespace culet
