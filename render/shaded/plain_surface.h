#pragma once
// Colours of surfaces for the plain shadings.

#include "render/scene/scene.h"
#include "render/scene/surface_colour.h"

namespace culet {

/// As an illumination model has it.
struct PlainSurface {
    Rgb colour{0.5, 0.5, 0.5};  ///< of ambient and diffuse reflection
    Rgb highlight{1, 1, 1};     ///< of specular reflection
    bool glows = false;         ///< an emitter: `colour` is its radiance, and nothing is reflected
};

/// An object's albedo, a metal's reflectance at normal incidence (its highlights too), the colour
/// of `thickness` of glass.
PlainSurface plain_surface(const SurfaceMaterial& material, double thickness);
/// A stone's body colour, 0..1.
PlainSurface plain_surface(const Stone& stone);

/// The two parts of `body_colour` as one absorption for each primary, Napierian, per length.
Rgb stone_absorption(const Stone& stone);

/// n and k of a metal for each primary; k is infinite where all is reflected.
struct MetalIndex {
    Rgb n, k;
};
MetalIndex index_of(const MetalMaterial& metal);

}  // namespace culet
