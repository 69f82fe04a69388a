#pragma once
// What a page offers to choose from. Private to the room: shows JSON.

#include <nlohmann/json.hpp>

#include "render/scene/scene.h"
#include "viewer/engine/viewer_document.h"

namespace culet {

/// The catalogue: name, optic, index at the sodium line, summary, colour (#rrggbb of a stone of
/// the usual size).
nlohmann::ordered_json material_list();
/// Presets of lights and the instruments.
nlohmann::ordered_json light_list();
/// Directions to look from: key, label, towards the eye, up, from_below.
nlohmann::ordered_json view_list();
/// The standard cuts with their parameters.
nlohmann::ordered_json cut_list();

/// Name, facets, middle, size of a stone.
nlohmann::ordered_json summary_of(const ViewedStone& stone);
nlohmann::ordered_json json_of(const Camera& camera);
/// What of a scene's settings a page shows.
nlohmann::ordered_json settings_of(const Scene& scene);

}  // namespace culet
