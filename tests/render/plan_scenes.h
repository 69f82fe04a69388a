#pragma once
// The scenes on which plans are measured: materials of the catalogue x cuts x lights.

#include <string>
#include <vector>

#include "render/scene/scene.h"

namespace culet {

struct PlanScene {
    std::string name;  ///< material, cut, light
    Scene scene;
};

/// Sixty scenes; the first ones are as different from each other as the last. `pixels` along a
/// side.
std::vector<PlanScene> plan_scenes(int pixels);
PlanScene plan_scene_of(const std::string& material, const std::string& cut,
                        const std::string& light, int pixels);

}  // namespace culet
