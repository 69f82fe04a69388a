#pragma once
// Scenes that plans are measured on: materials of the catalogue x cuts x lights.

#include <string>
#include <vector>

#include "render/scene/scene.h"

namespace culet {

struct PlanScene {
    std::string name;  ///< material, cut, light
    Scene scene;
};

/// Sixty, the first ones as unlike each other as the last; `pixels` along a side.
std::vector<PlanScene> plan_scenes(int pixels);
/// One of them.
PlanScene plan_scene_of(const std::string& material, const std::string& cut,
                        const std::string& light, int pixels);

}  // namespace culet
