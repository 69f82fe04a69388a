#pragma once
// Writes stones for the web and for Blender: glTF 2.0.

#include <array>
#include <optional>
#include <string>

#include "stone/stone.h"

namespace culet {

/// The material's look, for the extensions KHR_materials_ior, _transmission, _volume and
/// _dispersion. Without it the surface is plain grey.
struct GltfLook {
    double index = 1.5;     ///< at 587.6 nm
    double dispersion = 0;  ///< 20 / Abbe number; 0: none
    /// White light has this colour (linear sRGB, 0..1) after `attenuation_mm`.
    std::array<double, 3> attenuation_colour{1, 1, 1};
    std::optional<double> attenuation_mm;
};

enum class GltfForm {
    binary,  ///< .glb
    text     ///< .gltf, with the buffer inside
};

/// `stone` is in the frame of `in_export_frame`; the file has glTF's metres and +y up.
///
/// One mesh of one primitive, with flat facets that have their own corners (single precision). The
/// mesh's extras hold `facets`: name, first triangle, number of triangles, plane (`normal` in
/// culet's frame, `offset_mm`), inclination and azimuth in degrees, area. The node's extras hold
/// size, volume, weight, density, index, material. The same stone gives the same bytes. Throws
/// InputError for a solid without facets.
std::string gltf_bytes(const Stone& stone, const std::optional<GltfLook>& look, GltfForm form);

/// Leaves out the colour (see render/export). Takes the mean index at the d line, and the
/// dispersion from the F to the C line.
GltfLook gltf_look_of(const Material& material);

}  // namespace culet
