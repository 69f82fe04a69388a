#pragma once
// The plan of a scene, for people.

#include <string>

#include "render/engine/scene_plan.h"
#include "render/scene/scene.h"
#include "stone/progress/progress.h"

namespace culet {

/// Throws InputError as `render` does, and Interrupted.
ScenePlan plan_scene(const Scene& scene, const Progress& progress = {});
/// The same plan for people who want to know: what effects would bring that the scene switches off
/// is measured too, and is part of the bound.
ScenePlan plan_to_explain(const Scene& scene, const Progress& progress = {});

/// Lines of the plan that are no effects: depth, wavelengths, samples, light_edges,
/// environment_filter and objects, for its settings. `user`: as the scene has them.
void set_resolutions(ScenePlan& plan, const Scene& scene, const RenderSettings& user);

/// One line an item.
std::string explain(const ScenePlan& plan);
/// The same as JSON, one object.
std::string plan_json(const ScenePlan& plan);

}  // namespace culet
