#pragma once
// What `culet render --stats STATS.json` chose, for another picture of the same stone and light.

#include <filesystem>
#include <string>
#include <vector>

#include "render/engine/scene_plan.h"
#include "render/scene/scene.h"

namespace culet {

struct SavedPlan {
    std::filesystem::path file;
    std::vector<std::string> settings;  ///< keys of a scene, "render.engine=..."
    std::string stone_and_light;
    double checked_bound = 0;

    /// Throws InputError where the scene has another stone or other lights.
    ScenePlan of(const Scene& scene) const;
};

/// Throws InputError: no JSON, or none with a plan in it.
SavedPlan read_saved_plan(const std::filesystem::path& file);

}  // namespace culet
