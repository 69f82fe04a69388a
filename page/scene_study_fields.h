#pragma once
// Fields of a scene study's JSON, as its table, its chart and its page have them.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace culet {

/// Empty where there is none.
nlohmann::json object_at(const nlohmann::json& object, const char* key);
/// The setting of that id; nothing for an id that is not there.
const nlohmann::json* row_of(const nlohmann::json& study, const std::optional<double>& id);
/// The settings on the front, quickest first.
std::vector<const nlohmann::json*> front_of(const nlohmann::json& study);
/// What the reference itself may be off by.
double noise_of(const nlohmann::json& study);

/// Of one setting.
std::string words_in(const nlohmann::json& row);
std::string ms(const nlohmann::json& row, const char* key = "cpu_seconds");
std::string error_of(const nlohmann::json& row);
/// As people write tolerances: 0.1, 0.003.
std::string tolerance_of(const nlohmann::json& row);

}  // namespace culet
