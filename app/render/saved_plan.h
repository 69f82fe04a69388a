#pragma once
// The settings that `culet render --stats STATS.json` chose, for another picture of the same stone
// and light.

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

    /// Throws InputError if the scene has another stone or other lights.
    ScenePlan of(const Scene& scene) const;
};

/// Throws InputError if the file is not JSON or has no plan.
SavedPlan read_saved_plan(const std::filesystem::path& file);

}  // namespace culet
