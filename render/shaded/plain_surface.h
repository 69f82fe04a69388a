#pragma once
// Colours of surfaces for the local shadings.

#include "render/scene/scene.h"
#include "render/scene/surface_colour.h"

namespace culet {

/// Parameters of an illumination model.
struct PlainSurface {
    Rgb colour{0.5, 0.5, 0.5};  ///< ambient and diffuse reflectance
    Rgb highlight{1, 1, 1};     ///< specular reflectance
    bool glows = false;         ///< an emitter with radiance `colour`, which reflects nothing
};

/// An object's albedo; a metal's reflectance at normal incidence, also for highlights; the colour
/// of `thickness` of glass.
PlainSurface plain_surface(const SurfaceMaterial& material, double thickness);
/// A stone's body colour, 0..1.
PlainSurface plain_surface(const Stone& stone);

/// Napierian absorption per length and primary, both parts of `body_colour` added.
Rgb stone_absorption(const Stone& stone);

/// n and k of a metal per primary; k is infinite for total reflectance.
struct MetalIndex {
    Rgb n, k;
};
MetalIndex index_of(const MetalMaterial& metal);

}  // namespace culet
