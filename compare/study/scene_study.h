#pragma once
// What accuracy costs in time: draws one scene with many settings and compares each with the
// reference.
//
// The reference is drawn by the reference renderer with all effects, a third of the finest
// tolerance, and as many rays per pixel as the budget allows. It is the mean of two drawings with
// different rays and random paths; half their difference estimates its error, and no smaller error
// is claimed.

#include <string>

#include "compare/study/scene_study_result.h"
#include "stone/progress/progress.h"

namespace culet {

/// Uses the seed and threads of the scene's settings. Throws InputError as `render` does, and when
/// the camera does not see the stone; Interrupted.
SceneStudy study_scene(const Scene& scene, const SceneStudyOptions& options = {},
                       const Progress& progress = {});

/// One JSON object (`schema` 1, `kind` "scene").
std::string scene_study_json(const SceneStudy& study);
/// The renders as comma-separated values.
std::string scene_study_csv(const SceneStudy& study);

}  // namespace culet
