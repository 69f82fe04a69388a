#pragma once
// The engines "beams" and "preview" behind render.h.

#include "render/render.h"

namespace culet {

bool drawn_by_beams(const RenderSettings& settings);
RenderResult render_with_beams(const Scene& scene, const Progress& progress);

}  // namespace culet
