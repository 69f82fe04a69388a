#pragma once
// Wavelengths that are traced together, and the stone's optics for them.

#include <array>

#include "render/optics/crystal.h"
#include "stone/material/spectrum.h"

namespace culet {

/// Largest number of wavelengths in a band; longer sets are split.
constexpr int k_band_nodes = 32;
using NodeWeights = std::array<double, k_band_nodes>;

/// Wavelength nodes that share one path geometry.
struct Band {
    int first = 0, count = 1;  ///< of the wavelength set
    double n = 1.5;            ///< of an isotropic stone; the mean index if birefringence is left
                               ///< out
    bool two_waves = false;    ///< `crystal` has two different waves
    Crystal crystal;
    double n_outside = 1;
    bool absorbs = false;
    /// Per unit of length, by principal axis of the crystal. All equal for isotropic absorption.
    std::array<NodeWeights, 3> absorption{};
    /// Vacuum wavelength in the stone's unit of length.
    double wavelength = 1e-6 * k_d_line_nm;
    /// Retardation, in the stone's unit of length, beyond which a crystal's waves are followed
    /// separately: wavelength^2 / bandwidth. 0: always; infinite: monochromatic light.
    double coherence_length = 0;
};

}  // namespace culet
