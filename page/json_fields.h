#pragma once
// Fields of a JSON object that may be missing or of another type, and numbers to write. Templates,
// so that no public header of the folder shows a JSON library; `Json` is nlohmann's.

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "stone/text/errors.h"

namespace culet {

/// Throws InputError that names `what` when the text is not a JSON object. Empty text gives an
/// empty object.
template <typename Json>
Json parsed_object(const std::string& text, const char* what) {
    if (text.empty()) return Json::object();
    Json json = Json::parse(text, nullptr, false);
    if (json.is_object()) return json;
    throw InputError(std::string(what) + ": is not a JSON object");
}

template <typename Json>
Json parsed_study(const std::string& text) {
    return parsed_object<Json>(text, "the study");
}

template <typename Json>
std::optional<double> number_at(const Json& object, const char* key) {
    if (!object.is_object()) return std::nullopt;
    const auto found = object.find(key);
    if (found == object.end() || !found->is_number()) return std::nullopt;
    return found->template get<double>();
}

/// Returns NaN for a missing field.
template <typename Json>
double value_at(const Json& object, const char* key) {
    return number_at(object, key).value_or(std::numeric_limits<double>::quiet_NaN());
}

template <typename Json>
std::string text_at(const Json& object, const char* key) {
    if (!object.is_object()) return {};
    const auto found = object.find(key);
    if (found == object.end() || !found->is_string()) return {};
    return found->template get<std::string>();
}

template <typename Json>
bool true_at(const Json& object, const char* key) {
    if (!object.is_object()) return false;
    const auto found = object.find(key);
    return found != object.end() && found->is_boolean() && found->template get<bool>();
}

template <typename Json>
const Json& array_at(const Json& object, const char* key) {
    static const Json none = Json::array();
    if (!object.is_object()) return none;
    const auto found = object.find(key);
    return found != object.end() && found->is_array() ? *found : none;
}

/// Writes null for a missing number, NaN and infinity, which JSON lacks.
template <typename Json>
Json json_number(const std::optional<double>& value) {
    return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

}  // namespace culet
