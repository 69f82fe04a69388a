#pragma once
// What an analyser and a retarder let through of the light that reaches the eye.

#include "render/optics/stokes.h"
#include "render/scene/scene.h"

namespace culet {

/// The row that turns Stokes parameters into the radiance behind the optics: {1, 0, 0, 0} when
/// there are none. An ideal analyser passes half of unpolarised light. `window`: 0, or 1 for the
/// second of a dichroscope.
Stokes response(const EyeOptics& optics, double wavelength_nm, int window = 0);

}  // namespace culet
