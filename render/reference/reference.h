#pragma once
// The engine "reference" behind render.h.

#include "render/render.h"

namespace culet {

/// With the scene's settings as they are; what they leave open is as exact as the tolerance asks
/// for.
RenderResult render_with_reference(const Scene& scene, const Progress& progress);

}  // namespace culet
