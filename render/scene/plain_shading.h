#pragma once
// What the plain shadings (engines flat, gouraud, phong, whitted) need beyond the physical scene:
// [shading] of scene files, see docs/engines.md.

#include <array>

#include "stone/text/toml_file.h"

namespace culet {

/// The illumination model of Phong (1975): ambient, diffuse and specular coefficients, which
/// multiply the surface's colour and the lights, and the specular exponent. Light from a place is
/// divided by c + l a + q a^2, a being the distance over that from the light to the middle of the
/// scene. The defaults are the inverse square of physics.
struct PlainShading {
    double ambient = 1, diffuse = 1, specular = 0.3;
    double exponent = 40;
    std::array<double, 3> attenuation{0, 0, 1};  ///< constant, linear, quadratic

    bool operator==(const PlainShading&) const = default;
};

/// Throws InputError.
PlainShading read_shading(const TomlTable& table);

}  // namespace culet
