#pragma once
// What the lights of a scene, and the things that they meet on their way to the stone, call for.

#include "render/scene/scene.h"

namespace culet {

/// What of that depends on wavelength. D65 is flat here (colour.h).
enum class LightNeeds { one_wavelength, three_for_rgb, a_spectrum };
LightNeeds light_needs(const Scene& scene);

/// What stands around the stone turns unpolarised light into polarised light.
bool surroundings_polarise(const Scene& scene);

}  // namespace culet
