#include "page/scene_study_fields.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "page/html.h"
#include "page/json_fields.h"

namespace culet {

using Json = nlohmann::json;

Json object_at(const Json& object, const char* key) {
    if (!object.is_object() || !object.contains(key) || !object[key].is_object())
        return Json::object();
    return object[key];
}

const Json* row_of(const Json& study, const std::optional<double>& id) {
    if (!id) return nullptr;
    for (const Json& row : array_at(study, "settings")) {
        if (number_at(row, "id") == id) return &row;
    }
    return nullptr;
}

std::vector<const Json*> front_of(const Json& study) {
    std::vector<const Json*> rows;
    for (const Json& id : array_at(study, "front")) {
        if (!id.is_number()) continue;
        if (const Json* row = row_of(study, id.get<double>())) rows.push_back(row);
    }
    return rows;
}

std::string words_in(const Json& row) {
    const std::string words = text_at(row, "words");
    return words.empty() ? text_at(row, "setting") : words;
}

std::string ms(const Json& row, const char* key) {
    const auto seconds = number_at(row, key);
    return seconds ? significant(1000 * *seconds) : "–";
}

std::string error_of(const Json& row) {
    return (true_at(row, "at_noise") ? "≤ " : "") + significant(number_at(row, "claimed_error"), 2);
}

std::string tolerance_of(const Json& row) {
    return fmt::format("{:g}", value_at(row, "tolerance"));
}

double noise_of(const Json& study) {
    return value_at(object_at(object_at(study, "reference"), "noise"), "error");
}

}  // namespace culet
