#pragma once
// Settings of the engines flat, gouraud, phong and whitted: [shading] of scene files
// (docs/engines.md).

#include <array>

#include "stone/text/toml_file.h"

namespace culet {

/// Phong's illumination model (1975). The coefficients multiply the surface's colour and the
/// lights. Light from a near source is divided by c + l a + q a^2, where a is its distance relative
/// to that from the light to the scene's middle. The defaults give the physical inverse square.
struct PlainShading {
    double ambient = 1, diffuse = 1, specular = 0.3;
    double exponent = 40;
    std::array<double, 3> attenuation{0, 0, 1};  ///< constant, linear, quadratic

    bool operator==(const PlainShading&) const = default;
};

/// Throws InputError.
PlainShading read_shading(const TomlTable& table);

}  // namespace culet
