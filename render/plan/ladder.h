#pragma once
// Pictures from coarse to fine, each held against the reference, until one is near enough.

#include "render/render.h"

namespace culet {

RenderResult drawn_by_ladder(const Scene& scene, const Progress& progress);

}  // namespace culet
