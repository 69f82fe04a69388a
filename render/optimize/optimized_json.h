#pragma once
// What an optimisation changed, as JSON (docs/optimize.md) and in the words of a cutting sheet.

#include <string>
#include <vector>

#include "render/optimize/optimize.h"
#include "stone/design/design.h"

namespace culet {

/// For each tier, the titles of the design's tiers that hold its facets: "P1", "C1 C2".
std::vector<std::string> tier_words(const Solid& solid, const Design& design,
                                    const std::vector<FacetTier>& tiers);
/// Of the tiers of `result`; `design` as of its start.
std::vector<std::string> tier_words(const Optimized& result, const Design& design);

/// Merits before and after, and the tiers' angles; `design` as of `result.start`. `objective`: the
/// merit's weights as words.
std::string optimized_json(const Optimized& result, const Design& design,
                           const OptimizeOptions& options, const std::string& objective);

}  // namespace culet
