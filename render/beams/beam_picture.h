#pragma once
// The engines "beams" and "preview" behind render.h.

#include "render/render.h"

namespace culet {

/// Why beams cannot draw this, in words; empty: they can.
std::string refused_by_beams(const Scene& scene, const OpticalSetup& setup);

bool drawn_by_beams(const RenderSettings& settings);
RenderResult render_with_beams(const Scene& scene, const Progress& progress);

}  // namespace culet
