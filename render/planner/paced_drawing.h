#pragma once
// Pictures whose tolerance is what a given amount of work allows.

#include <functional>

#include "render/engine/render_result.h"
#include "render/scene/scene.h"
#include "stone/progress.h"

namespace culet {

/// Draws one picture to its tolerance; may throw OverAllowance.
using DrawToTolerance = std::function<RenderResult(const Scene&, const Progress&)>;

/// Coarsely first, then as finely as what that took says the rest of `settings.allowed_ns` allows,
/// and again while a next step is likely to fit in; the finest is `settings.tolerance`. Work is
/// counted and not timed: the same scene has the same picture, whatever the machine does beside it.
/// `better` is told of each picture that is nearer than those before. The result's
/// `allowed_tolerance` is set. Throws Interrupted.
RenderResult draw_within_allowance(const Scene& scene, const Progress& progress,
                                   const DrawToTolerance& draw, const PictureSink& better);

}  // namespace culet
