#pragma once
// The tables of a fit report. Private to the room: shows JSON.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace culet {

/// Both folded, with how many there are.
std::string readings_table(const nlohmann::json& fit, const std::string& length_unit);
std::string facets_table(const nlohmann::json& fit, const std::string& unit);

}  // namespace culet
