#pragma once
// The scene from the photograph's camera position.

#include <vector>

#include "compare/photo/photo.h"
#include "render/scene/scene.h"
#include "stone/progress/progress.h"

namespace culet {

/// Cut to the stone, at most 256 pixels across. `find_pose` false: uses the scene's camera. Throws
/// InputError when the pose cannot be found.
Scene photograph_scene(const Photo& photo, const Scene& scene, bool find_pose, int threads,
                       const Progress& progress = {});

}  // namespace culet
