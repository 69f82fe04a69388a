#include "render/export/gltf_look.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/colour/material_colour.h"

namespace culet {

namespace {

// Least value of a colour: glTF takes its logarithm, so black would be opaque at every length.
constexpr double k_darkest = 1e-4;

}  // namespace

GltfMaterial gltf_material(const Material& material, double width_mm) {
    GltfMaterial result;
    result.look = gltf_look_of(material);
    if (material.optic != OpticCharacter::isotropic) {
        result.notes.push_back(
            fmt::format("double refraction: the mean index {:.4f} is written", result.look.index));
    }
    if (!material.has_absorption()) return result;
    const double path = light_path_mm(width_mm);
    const Rgb body = body_colour(material, width_mm).rgb;
    Rgb shown = body;
    for (double& channel : shown) channel = std::clamp(channel, k_darkest, 1.0);
    if (shown != body)
        result.notes.emplace_back("a colour outside sRGB: the nearest inside it is written");
    result.look.attenuation_colour = shown;
    result.look.attenuation_mm = path;
    result.notes.push_back(
        fmt::format("the spectrum of absorption: the colour after {:.3g} mm is written", path));
    return result;
}

}  // namespace culet
