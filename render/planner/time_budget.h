#pragma once
// Pictures whose tolerance, or rays where light is sampled at random, are what a given amount of
// work allows. Work is counted (work_meter.h) and not timed: the same scene has the same picture,
// whatever the machine does beside it.

#include <functional>

#include "render/engine/render_result.h"
#include "render/scene/scene.h"
#include "stone/progress/progress.h"

namespace culet {

/// Draws one picture to its tolerance; may throw OverBudget.
using DrawToTolerance = std::function<RenderResult(const Scene&, const Progress&)>;

/// Coarsely first, then as finely as what that took says the rest of `settings.allowed_ns` allows,
/// and again while a next step is likely to fit in; the finest is `settings.tolerance`. `better` is
/// told of each picture that is nearer than those before. The result's `allowed_tolerance` is set.
/// Throws Interrupted.
RenderResult draw_within_budget(const Scene& scene, const Progress& progress,
                                const DrawToTolerance& draw, const PictureSink& better);

/// Whether `render` chooses the rays of a pixel by `settings.allowed_ns`: where objects stand
/// around the stone, light is sampled at random, and every ray makes the picture less noisy.
bool leaves_samples_open(const Scene& scene);

/// `scene` with as many rays a pixel as `settings.allowed_ns` allows, or fewer that bring the noise
/// of a pixel to `settings.tolerance`. Where one ray at all wavelengths is more than is allowed,
/// three wavelengths, and then a crystal's two waves merged. Work is counted at some pixels. Throws
/// Interrupted.
Scene with_allowed_samples(const Scene& scene, const Progress& progress);

}  // namespace culet
