#pragma once
// Explains the plan of a scene to people.

#include <string>

#include "render/engine/scene_plan.h"
#include "render/scene/scene.h"
#include "stone/progress/progress.h"

namespace culet {

/// Throws InputError as `render` does, and Interrupted.
ScenePlan plan_scene(const Scene& scene, const Progress& progress = {});
/// The same, but effects that the scene switches off are measured too, and are part of the bound.
ScenePlan plan_to_explain(const Scene& scene, const Progress& progress = {});

/// Adds the plan's lines that are not effects: depth, wavelengths, samples, light_edges,
/// environment_filter and objects. `user`: the scene's own settings.
void set_resolutions(ScenePlan& plan, const Scene& scene, const RenderSettings& user);

/// One line per item.
std::string explain(const ScenePlan& plan);
/// As one JSON object.
std::string plan_json(const ScenePlan& plan);

}  // namespace culet
