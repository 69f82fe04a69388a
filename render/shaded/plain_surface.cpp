#include "render/shaded/plain_surface.h"

#include <algorithm>
#include <cmath>

#include "render/colour/material_colour.h"
#include "render/optics/conductor.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

constexpr double k_darkest = 1e-4;  // least body colour; darker ones look equally black

Rgb white() {
    return {1, 1, 1};
}

double width_mm(const Stone& stone) {
    return mm_per(stone.unit) *
           std::min(width_along(stone.solid, {1, 0, 0}), width_along(stone.solid, {0, 1, 0}));
}

Rgb shown_colour(const Stone& stone) {
    Rgb rgb = body_colour(stone.material, width_mm(stone)).rgb;
    for (double& c : rgb) c = std::clamp(c, k_darkest, 1.0);
    return rgb;
}

PlainSurface surface_of(const DiffuseMaterial& material, double) {
    return {rgb_of(material.albedo), white(), false};
}

PlainSurface surface_of(const MetalMaterial& metal, double) {
    const MetalIndex index = index_of(metal);
    Rgb f0;
    for (std::size_t c = 0; c < 3; ++c) f0[c] = conductor_reflectance(index.n[c], index.k[c], 1);
    return {f0, f0, false};
}

PlainSurface surface_of(const MirrorMaterial& mirror, double) {
    return {rgb_of(mirror.albedo), rgb_of(mirror.albedo), false};
}

PlainSurface surface_of(const DielectricMaterial& glass, double thickness) {
    Rgb colour = rgb_of(glass.absorption);
    for (double& c : colour) c = std::exp(-c * thickness);
    return {colour, white(), false};
}

PlainSurface surface_of(const EmitterMaterial& emitter, double) {
    static const WavelengthSet wavelengths({400, 430, 460, 490, 520, 550, 580, 610, 640, 670, 700});
    return {wavelengths.rgb_of(radiance_of(emitter.radiance, wavelengths).data()), white(), true};
}

}  // namespace

PlainSurface plain_surface(const SurfaceMaterial& material, double thickness) {
    return std::visit([&](const auto& m) { return surface_of(m, thickness); }, material);
}

PlainSurface plain_surface(const Stone& stone) {
    return {shown_colour(stone), white(), false};
}

Rgb stone_absorption(const Stone& stone) {
    Rgb absorption = shown_colour(stone);
    const double path = light_path_mm(width_mm(stone)) / mm_per(stone.unit);
    for (double& c : absorption) c = -std::log(c) / path;
    return absorption;
}

MetalIndex index_of(const MetalMaterial& metal) {
    if (!metal.f0) return {rgb_of(metal.n), rgb_of(metal.k)};
    MetalIndex index{white(), rgb_of(*metal.f0)};
    for (double& c : index.k) c = extinction_of_reflectance(c);
    return index;
}

}  // namespace culet
