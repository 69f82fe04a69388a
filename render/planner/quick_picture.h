#pragma once
// A first picture within about a second.

#include "render/engine/render_result.h"
#include "render/scene/scene.h"
#include "stone/progress/progress.h"

namespace culet {

/// Draws a picture to show while a better one is drawn: a crystal's two waves merged, few
/// wavelengths, the coarsest beams, or one reference ray per pixel if beams refuse. Its
/// `error_bound` is NaN. Throws as `render` does.
RenderResult draw_quickly(const Scene& scene, const Progress& progress = {});

}  // namespace culet
