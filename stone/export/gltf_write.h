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

/// `stone` is in the frame of `in_export_frame`. The file has glTF's metres and +y up, and the
/// stone's true size.
///
/// One mesh of one primitive; every facet is flat and has corners of its own (single precision).
/// The mesh's extras hold `facets`: name, first triangle and number of triangles, plane (`normal`
/// in culet's frame, `offset_mm`), inclination and azimuth in degrees, area. The node's extras hold
/// what is known of the stone: size, volume, weight, density, index, material. The same stone gives
/// the same bytes. Throws InputError for a solid without facets.
std::string gltf_bytes(const Stone& stone, const std::optional<GltfLook>& look, GltfForm form);

/// The look of a material without its colour (see render/export): the principal rays' mean index at
/// the d line, and the dispersion from the F to the C line.
GltfLook gltf_look_of(const Material& material);

}  // namespace culet
