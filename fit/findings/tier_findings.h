#pragma once
// What the inclinations that were read say of each tier: the angle that its facets have in common,
// and which of them stand out.

#include <vector>

#include "fit/findings/result.h"

namespace culet {

/// By the readings themselves, before any fit: of each facet the weighted mean of its own. Where
/// the mesh is a design whose tier has several angles (an oval's mains), how far each is off its
/// own. Facets stand out together when the likeliest split of the tier into a majority and a few is
/// surer than the level, Bonferroni over all splits. `left_out` are readings that count nothing.
std::vector<NamedTierFinding> tier_findings(const Stone& stone,
                                            const std::vector<Reading>& readings,
                                            const std::vector<std::string>& left_out,
                                            bool is_design);

}  // namespace culet
