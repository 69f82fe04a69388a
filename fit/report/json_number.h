#pragma once
// Numbers in reports. Private to the room: shows nlohmann's JSON.

#include <cmath>
#include <nlohmann/json.hpp>

namespace culet {

/// What is not known is null: JSON has no other word for it.
inline nlohmann::ordered_json json_number(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

}  // namespace culet
