#pragma once
// The tables of a fit report. Private to the folder: shows JSON.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace culet {

/// Both are collapsed, with their number of rows.
std::string readings_table(const nlohmann::json& fit, const std::string& length_unit);
std::string facets_table(const nlohmann::json& fit, const std::string& unit);

}  // namespace culet
