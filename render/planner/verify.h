#pragma once
// Verifies that a finished picture is as close to the truth as it claims.

#include "render/engine/render_result.h"
#include "render/scene/scene.h"
#include "stone/progress/progress.h"

namespace culet {

/// Redraws some pixels with everything on, with 64 to 256 rays each. `progress` receives 0 and may
/// stop it: Interrupted.
Verification verify(const Scene& scene, const RenderResult& result, int pixels = 128,
                    const Progress& progress = {});

}  // namespace culet
