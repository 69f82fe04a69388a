#pragma once
// Draws pictures for engines without wavelengths: ray by ray, in three primaries.

#include <functional>
#include <string>

#include "render/engine/render_result.h"
#include "render/setup/optical_setup.h"
#include "stone/progress/progress.h"

namespace culet {

/// What a ray sees. `number` is the ray's index in the picture, for random choices.
struct SeenColour {
    Rgb colour{0, 0, 0};
    bool met = false;  ///< met a stone or an object
};
using SeeRay = std::function<SeenColour(const EyeRay& ray, std::uint64_t number)>;

/// Rays per pixel if the scene names none.
constexpr int k_shaded_samples = 16;

/// Each pixel is the mean of its rays. The bytes do not depend on the number of threads. Throws
/// Interrupted.
RenderResult shaded_picture(const Scene& scene, const std::string& engine, const SeeRay& see,
                            const Progress& progress);

/// Why engines without polarisation and spectra cannot draw the scene; empty if they can.
std::string refused_by_shading(const Scene& scene);
/// Throws InputError for those, and for scenes that no engine draws (scene_checks.h).
void require_shadable(const Scene& scene);

}  // namespace culet
