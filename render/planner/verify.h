#pragma once
// Is a finished picture as near to the truth as it says?

#include "render/engine/render_result.h"
#include "render/scene/scene.h"
#include "stone/progress/progress.h"

namespace culet {

/// Draws some pixels anew with everything on: the time of so many pixels of 64 to 256 rays
/// each. `progress` is told 0, and may stop it: Interrupted.
Verification verify(const Scene& scene, const RenderResult& result, int pixels = 128,
                    const Progress& progress = {});

}  // namespace culet
