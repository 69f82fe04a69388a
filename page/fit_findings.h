#pragma once
// A fit's findings beyond facets and readings. Private to the folder: shows JSON.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace culet {

/// Tiers against the table and against the stone's own axis; further readings that would help;
/// meets, edges and facets that contradict the readings; symmetry. Each is collapsed, and present
/// only if the report has it.
std::string findings_tables(const nlohmann::json& fit, const std::string& length_unit);

}  // namespace culet
