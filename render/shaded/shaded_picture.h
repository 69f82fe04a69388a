#pragma once
// A picture of an engine that knows no wavelengths: ray by ray, in three primaries.

#include <functional>
#include <string>

#include "render/engine/render_result.h"
#include "render/setup/optical_setup.h"
#include "stone/progress/progress.h"

namespace culet {

/// What a ray sees. `number` is its own in the picture, for what is chosen at random.
struct SeenColour {
    Rgb colour{0, 0, 0};
    bool met = false;  ///< a stone or an object
};
using SeeRay = std::function<SeenColour(const EyeRay& ray, std::uint64_t number)>;

/// Rays a pixel where the scene does not say.
constexpr int k_shaded_samples = 16;

/// Every pixel is the mean of its rays. The same bytes whatever the threads. Throws Interrupted.
RenderResult shaded_picture(const Scene& scene, const std::string& engine, const SeeRay& see,
                            const Progress& progress);

/// What engines without polarisation and spectra refuse.
std::string refused_by_shading(const Scene& scene);
/// Throws InputError for that, and for scenes that no engine draws (scene_checks.h).
void require_shadable(const Scene& scene);

}  // namespace culet
