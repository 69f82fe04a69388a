#pragma once
// The stone's optics at the wavelengths of a setup.

#include "render/setup/optical_setup.h"

namespace culet {

/// Adds the bands to a setup that has its effects and wavelengths. `coloured`: the stone's
/// absorption depends on wavelength.
void add_bands(const Scene& scene, bool coloured, OpticalSetup& setup);

}  // namespace culet
