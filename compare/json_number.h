#pragma once
// Numbers in reports. Private to the room: shows nlohmann's JSON.

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace culet {

/// JSON has no infinity and no NaN: such a number is written as null.
inline nlohmann::ordered_json number(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

inline nlohmann::ordered_json number(const std::optional<double>& value) {
    return value ? number(*value) : nlohmann::ordered_json(nullptr);
}

}  // namespace culet
