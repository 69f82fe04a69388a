#pragma once
// JSON as the page gets it. Private to the room: shows nlohmann's JSON.

#include <nlohmann/json.hpp>
#include <string>

namespace culet {

/// On one line. Bytes of file names that are not UTF-8 become U+FFFD.
inline std::string text_of(const nlohmann::ordered_json& json) {
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace culet
