#pragma once
// The lines of a plan that are no effects: how finely a picture is resolved.

#include "render/engine/scene_plan.h"

namespace culet {

/// Depth, wavelengths, samples, light_edges, environment_filter and objects, for the settings of
/// the plan, in place of those that are there. `user`: as the scene has them.
void set_resolutions(ScenePlan& plan, const Scene& scene, const RenderSettings& user);

}  // namespace culet
