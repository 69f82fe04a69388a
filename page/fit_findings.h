#pragma once
// What a fit found out beyond facets and readings. Private to the room: shows JSON.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace culet {

/// Tiers against the table and against the stone's own axis; further readings that would help;
/// meets, edges and facets that the readings deny; symmetry. SignAmbiguity, and each only where the
/// report has it.
std::string findings_tables(const nlohmann::json& fit, const std::string& length_unit);

}  // namespace culet
