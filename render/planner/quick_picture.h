#pragma once
// A first picture, at once.

#include "render/engine/render_result.h"
#include "render/scene/scene.h"
#include "stone/progress/progress.h"

namespace culet {

/// A picture to be looked at while a better one is drawn: a crystal's two waves merged, few
/// wavelengths, the coarsest beams where the scene can be drawn by them, else one ray a pixel. Its
/// `error_bound` is NaN: nobody knows how near it is. Throws as `render`.
RenderResult draw_quickly(const Scene& scene, const Progress& progress = {});

}  // namespace culet
