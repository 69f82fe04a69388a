#pragma once
// The part of the fit report that tells what was found out. Private to the room: shows JSON.

#include <nlohmann/json.hpp>

#include "fit/findings/result.h"

namespace culet {

/// Adds `tier_angles`, `proportions`, `disagreeing`, `proposals`, `undetermined`, `help` and, when
/// they were looked for, `own_axis`, `tiers`, `meets.list`, `meets.proposals`, `shape`, `changes`
/// and `symmetry`, and `inclination_own_axis` to the facets.
void add_findings(const FitResult& result, nlohmann::ordered_json& report);

}  // namespace culet
