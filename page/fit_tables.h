#pragma once
// The tables of a fit report. Private to the room: shows JSON.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace culet {

std::string readings_table(const nlohmann::json& fit);
std::string facets_table(const nlohmann::json& fit, const std::string& unit);

}  // namespace culet
