#pragma once
// Fields of a scene study's JSON, for its table, chart and page.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace culet {

/// Empty if missing.
nlohmann::json object_at(const nlohmann::json& object, const char* key);
/// The setting of that id; null for an unknown id.
const nlohmann::json* row_of(const nlohmann::json& study, const std::optional<double>& id);
/// The settings on the Pareto front, quickest first.
std::vector<const nlohmann::json*> front_of(const nlohmann::json& study);
/// The error of the reference itself.
double noise_of(const nlohmann::json& study);

std::string words_in(const nlohmann::json& row);
std::string ms(const nlohmann::json& row, const char* key = "cpu_seconds");
std::string error_of(const nlohmann::json& row);
/// As people write tolerances: 0.1, 0.003.
std::string tolerance_of(const nlohmann::json& row);

}  // namespace culet
