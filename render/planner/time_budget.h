#pragma once
// Pictures for a given amount of work, which decides the tolerance, or the rays if light is sampled
// at random. Work is counted (work_meter.h), so a scene has the same picture however busy the
// machine is.

#include <functional>

#include "render/engine/render_result.h"
#include "render/scene/scene.h"
#include "stone/progress/progress.h"

namespace culet {

/// Draws one picture to its tolerance; may throw OverBudget.
using DrawToTolerance = std::function<RenderResult(const Scene&, const Progress&)>;

/// Draws coarsely, then as finely as the rest of `settings.allowed_ns` allows by estimate, and
/// again while another step probably fits; never finer than `settings.tolerance`. `better` receives
/// each improved picture. Sets `allowed_tolerance`. Throws Interrupted.
RenderResult draw_within_budget(const Scene& scene, const Progress& progress,
                                const DrawToTolerance& draw, const PictureSink& better);

/// Whether `settings.allowed_ns` decides the rays per pixel: with objects around the stone, light
/// is sampled at random.
bool leaves_samples_open(const Scene& scene);

/// `scene` with the rays per pixel that `settings.allowed_ns` allows, or fewer that reach
/// `settings.tolerance`. If one ray at all wavelengths is too much, uses three wavelengths, and
/// then merges a crystal's two waves. Throws Interrupted.
Scene with_allowed_samples(const Scene& scene, const Progress& progress);

}  // namespace culet
