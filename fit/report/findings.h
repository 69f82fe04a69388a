#pragma once
// The part of the fit report that tells of axis, tiers, meets, shape and symmetry. Private to the
// room: shows JSON.

#include <nlohmann/json.hpp>

#include "fit/findings/result.h"

namespace culet {

/// Adds `own_axis`, `tiers`, `meets.list`, `meets.proposals`, `shape`, `changes`
/// and, when it was looked for, `symmetry`; and `inclination_own_axis` to the facets.
void add_findings(const FitResult& result, nlohmann::ordered_json& report);

}  // namespace culet
