#pragma once
// What a scene's lights, and the objects that they meet before the stone, require.

#include "render/scene/scene.h"

namespace culet {

/// Their dependence on wavelength. D65 is flat here (colour.h).
enum class LightNeeds { one_wavelength, three_for_rgb, a_spectrum };
LightNeeds light_needs(const Scene& scene);

/// True if the objects polarise unpolarised light.
bool surroundings_polarise(const Scene& scene);

}  // namespace culet
