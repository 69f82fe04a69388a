#pragma once
// Mean optical constants, for programs that do not know crystals.

#include "stone/material/material.h"

namespace culet {

/// Mean over the directions of vibration. In uniaxial crystals the ordinary ray has two of the
/// three.
template <class OfRay>
double mean_over_rays(OpticCharacter optic, OfRay&& of_ray) {
    if (optic == OpticCharacter::isotropic) return of_ray(0);
    return (of_ray(0) + of_ray(optic == OpticCharacter::uniaxial ? 0 : 2) + of_ray(1)) / 3;
}

inline double mean_index(const Material& material, double wavelength_nm) {
    return mean_over_rays(material.optic,
                          [&](std::size_t ray) { return material.index[ray].at(wavelength_nm); });
}

/// Napierian, per mm.
inline double mean_absorption(const Material& material, double wavelength_nm) {
    return mean_over_rays(material.optic, [&](std::size_t ray) {
        return material.absorption_per_mm[ray].at(wavelength_nm);
    });
}

}  // namespace culet
