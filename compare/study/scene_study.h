#pragma once
// What accuracy costs in time: one scene drawn in many ways, each held against the reference.
//
// The reference is the reference renderer with everything on, a third of the finest tolerance, and
// as many rays a pixel as the budget allows. It is drawn twice, with other rays and other random
// paths, and the mean of the two is the truth; half their difference is what the truth itself may
// be off by, and no error below that is claimed.

#include <string>

#include "compare/study/scene_study_result.h"
#include "stone/progress/progress.h"

namespace culet {

/// Studies the scene with the seed and threads of its settings. Throws InputError as `render` does,
/// and when the camera does not see the stone; Interrupted.
SceneStudy study_scene(const Scene& scene, const SceneStudyOptions& options = {},
                       const Progress& progress = {});

/// One JSON object (`schema` 1, `kind` "scene").
std::string scene_study_json(const SceneStudy& study);
/// The renders as comma-separated values.
std::string scene_study_csv(const SceneStudy& study);

}  // namespace culet
