#pragma once
// Stones and materials as the JSON of a page, exactly. Private to the room: shows JSON.

#include <nlohmann/json.hpp>

#include "viewer/engine/viewer_document.h"

namespace culet {

nlohmann::ordered_json json_of(const Material& material);
/// Throws InputError: not what `json_of` wrote.
Material material_from(const nlohmann::ordered_json& json);

nlohmann::ordered_json json_of(const Vec3& vector);
Vec3 vector_from(const nlohmann::ordered_json& json);

nlohmann::ordered_json json_of(const ViewedStone& stone);
ViewedStone stone_from(const nlohmann::ordered_json& json);

}  // namespace culet
