#pragma once
// Numbers in reports. Private to the room: shows nlohmann's JSON.

#include <cmath>
#include <nlohmann/json.hpp>

#include "stone/numbers/units.h"

namespace culet {

/// Unknown (non-finite) numbers become null.
inline nlohmann::ordered_json json_number(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

inline nlohmann::ordered_json json_degrees(double angle) {
    return json_number(degrees(angle));
}

template <class Elements, class Object>
nlohmann::ordered_json json_list(const Elements& elements, const Object& object) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const auto& element : elements) list.push_back(object(element));
    return list;
}

}  // namespace culet
