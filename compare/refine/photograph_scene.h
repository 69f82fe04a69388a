#pragma once
// The scene as a photograph shows it: its camera where the photograph's stood.

#include <vector>

#include "compare/photo/photo.h"
#include "render/scene/scene.h"
#include "stone/progress/progress.h"

namespace culet {

/// Cut to the stone, at most 256 pixels across. `find_pose`: the pose is found in the photograph;
/// else the scene's camera stands where it says. Throws InputError where it cannot be found.
Scene photograph_scene(const Photo& photo, const Scene& scene, bool find_pose, int threads,
                       const Progress& progress = {});

}  // namespace culet
