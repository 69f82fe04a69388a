#pragma once
// Stones and materials as a page's JSON, without loss. Private to the folder: shows JSON.

#include <nlohmann/json.hpp>

#include "viewer/engine/viewer_document.h"

namespace culet {

nlohmann::ordered_json json_of(const Material& material);
/// Throws InputError for JSON that `json_of` did not write.
Material material_from(const nlohmann::ordered_json& json);

nlohmann::ordered_json json_of(const Vec3& vector);
Vec3 vector_from(const nlohmann::ordered_json& json);

nlohmann::ordered_json json_of(const ViewedStone& stone);
nlohmann::ordered_json json_of(const ViewItem& item);
ViewedStone stone_from(const nlohmann::ordered_json& json);

}  // namespace culet
