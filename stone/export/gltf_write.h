#pragma once
// Stones for the web and for Blender: glTF 2.0.

#include <array>
#include <optional>
#include <string>

#include "stone/stone.h"

namespace culet {

/// How the material looks, for the extensions KHR_materials_ior, _transmission, _volume and
/// _dispersion. Nothing of it: a plain grey surface.
struct GltfLook {
    double index = 1.5;     ///< at 587.6 nm
    double dispersion = 0;  ///< 20 / Abbe number; 0: none
    /// White light is this colour (linear sRGB, 0..1) after so many mm.
    std::array<double, 3> attenuation_colour{1, 1, 1};
    std::optional<double> attenuation_mm;
};

enum class GltfForm {
    binary,  ///< .glb
    text     ///< .gltf, with the buffer inside
};

/// A stone in the frame of `in_export_frame`. glTF's lengths are metres and its up is +y: both are
/// written so, and the stone has its true size.
///
/// One mesh of one primitive, every facet flat with corners of its own (single precision). Extras
/// of the mesh hold `facets`: name, first triangle and number of triangles, plane (`normal` in
/// culet's frame, `offset_mm`), inclination and azimuth in degrees, area; extras of the node what
/// is known of the stone: size, volume, weight, density, index, material. The same stone gives the
/// same bytes. Throws InputError for a solid without facets.
std::string gltf_bytes(const Stone& stone, const std::optional<GltfLook>& look, GltfForm form);

/// `GltfLook` of a material but for its colour, for which see render/export: mean index of the
/// principal rays at the d line, and the dispersion from the F to the C line.
GltfLook gltf_look_of(const Material& material);

}  // namespace culet
