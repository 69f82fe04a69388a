#pragma once
// Wavelengths that are traced together, and the optics of the stone for them.

#include <array>

#include "render/optics/crystal.h"
#include "stone/material/spectrum.h"

namespace culet {

/// Most wavelengths that share one band; longer sets are split.
constexpr int k_band_nodes = 32;
using NodeWeights = std::array<double, k_band_nodes>;

/// Wavelength nodes that share one geometry, and the optics of the stone for them.
struct Band {
    int first = 0, count = 1;  ///< of the wavelength set
    double n = 1.5;            ///< of an isotropic stone, or the mean where the split is left out
    bool two_waves = false;    ///< the stone splits light: `crystal`
    Crystal crystal;
    double n_outside = 1;
    bool absorbs = false;
    /// Per unit of length, by principal axis of the crystal. All equal for isotropic absorption.
    std::array<NodeWeights, 3> absorption{};
    /// Vacuum wavelength in the stone's unit of length.
    double wavelength = 1e-6 * k_d_line_nm;
    /// Retardation, in the stone's unit of length, from which the two waves of a crystal are
    /// followed apart: wavelength^2 / bandwidth. 0: always; infinite: monochromatic light.
    double coherence_length = 0;
};

}  // namespace culet
