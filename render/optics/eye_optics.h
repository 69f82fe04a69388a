#pragma once
// The analyser and retarder in front of the eye.

#include <vector>

#include "render/optics/stokes.h"
#include "render/scene/scene.h"

namespace culet {

/// Row from Stokes parameters to the radiance behind the optics; {1, 0, 0, 0} without any. An ideal
/// analyser passes half of unpolarised light. `window`: 0, or 1 for a dichroscope's second.
Stokes response(const EyeOptics& optics, double wavelength_nm, int window = 0);

std::vector<Stokes> responses(const EyeOptics& optics, const std::vector<double>& wavelengths_nm);

/// Replaces the first plane of `stokes[plane * nodes + node]` by the radiance behind the optics;
/// one response per node.
void look_through(const std::vector<Stokes>& responses, int planes, double* stokes);

}  // namespace culet
