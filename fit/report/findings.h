#pragma once
// The findings in the fit report. Private to the room: shows JSON.

#include <nlohmann/json.hpp>

#include "fit/findings/result.h"

namespace culet {

/// Adds `tier_angles`, `proportions`, `disagreeing`, `proposals`, `undetermined`, `help`; if asked
/// for, also `own_axis`, `tiers`, `meets.list`, `meets.proposals`, `shape`, `changes`, `symmetry`,
/// and the facets' `inclination_own_axis`.
void add_findings(const FitResult& result, nlohmann::ordered_json& report);

}  // namespace culet
