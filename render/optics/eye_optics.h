#pragma once
// What an analyser and a retarder let through of the light that reaches the eye.

#include <vector>

#include "render/optics/stokes.h"
#include "render/scene/scene.h"

namespace culet {

/// The row that turns Stokes parameters into the radiance behind the optics: {1, 0, 0, 0} when
/// there are none. An ideal analyser passes half of unpolarised light. `window`: 0, or 1 for the
/// second of a dichroscope.
Stokes response(const EyeOptics& optics, double wavelength_nm, int window = 0);

/// Of each wavelength.
std::vector<Stokes> responses(const EyeOptics& optics, const std::vector<double>& wavelengths_nm);

/// `stokes[plane * nodes + node]`, of as many nodes as there are responses: the radiance behind the
/// optics takes the place of the first plane.
void look_through(const std::vector<Stokes>& responses, int planes, double* stokes);

}  // namespace culet
