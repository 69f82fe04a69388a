#pragma once
// Rays of a pixel that a given amount of work allows, where objects stand around the stone: light
// is sampled at random there, and every ray makes the picture less noisy.

#include "render/scene/scene.h"
#include "stone/progress.h"

namespace culet {

/// Whether `render` chooses the rays of a pixel by `settings.allowed_ns`.
bool leaves_samples_open(const Scene& scene);

/// `scene` with as many rays a pixel as `settings.allowed_ns` allows, or fewer that bring the noise
/// of a pixel to `settings.tolerance`. Where one ray at all wavelengths is more than is allowed,
/// three wavelengths, and then a crystal's two waves merged. Work is counted at some pixels. Throws
/// Interrupted.
Scene with_allowed_samples(const Scene& scene, const Progress& progress);

}  // namespace culet
