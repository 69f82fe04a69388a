#pragma once
// The choices that a page offers. Private to the folder: shows JSON.

#include <nlohmann/json.hpp>

#include "render/scene/scene.h"
#include "viewer/engine/viewer_document.h"

namespace culet {

/// Name, optic, index at the sodium line, summary; density and colour (#rrggbb for a stone of the
/// usual size) where they are known.
nlohmann::ordered_json material_list();
/// Light presets and the instruments.
nlohmann::ordered_json light_list();
nlohmann::ordered_json cut_list();

nlohmann::ordered_json summary_of(const ViewedStone& stone);
nlohmann::ordered_json json_of(const Camera& camera);
nlohmann::ordered_json settings_of(const Scene& scene);

}  // namespace culet
