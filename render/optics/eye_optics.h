#pragma once
// Transmission of the analyser and the retarder in front of the eye.

#include <vector>

#include "render/optics/stokes.h"
#include "render/scene/scene.h"

namespace culet {

/// The row that turns Stokes parameters into the radiance behind the optics; {1, 0, 0, 0} without
/// any. An ideal analyser passes half of unpolarised light. `window`: 0, or 1 for a dichroscope's
/// second.
Stokes response(const EyeOptics& optics, double wavelength_nm, int window = 0);

/// One response per wavelength.
std::vector<Stokes> responses(const EyeOptics& optics, const std::vector<double>& wavelengths_nm);

/// Replaces the first plane of `stokes[plane * nodes + node]` by the radiance behind the optics.
/// There are as many nodes as responses.
void look_through(const std::vector<Stokes>& responses, int planes, double* stokes);

}  // namespace culet
