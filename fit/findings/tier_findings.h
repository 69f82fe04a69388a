#pragma once
// What the inclination readings say of each tier: its common angle, and the facets that stand out.

#include <vector>

#include "fit/findings/result.h"

namespace culet {

/// Uses the readings alone: for each facet the weighted mean of its own. In a design whose tier has
/// several angles (an oval's mains), differences from each one's own angle are compared. Facets
/// stand out together if the likeliest split of the tier into a majority and a few passes the
/// significance level (Bonferroni over all splits). `left_out` readings do not count.
std::vector<NamedTierFinding> tier_findings(const Stone& stone,
                                            const std::vector<Reading>& readings,
                                            const std::vector<std::string>& left_out,
                                            bool is_design);

}  // namespace culet
