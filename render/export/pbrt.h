#pragma once
// Writes scenes for PBRT-v4, to check pictures with a renderer that keeps spectra.

#include <string>

#include "render/export/scene_parts.h"

namespace culet {

/// Unit direction at a place of PBRT's square environment maps, 0..1 from the left and top: the
/// equal-area octahedral mapping (Clarberg 2008; Pharr, Jakob & Humphreys 2023, 3.8.3), +z in the
/// middle, -z in the corners.
Vec3 equal_area_direction(double x, double y);

/// Keeps the scene's frame and lengths; PBRT's camera is left-handed and mirrored. `stem`: of the
/// scene's file; the name of the map of distant lights, written beside it, starts with it.
///
/// Exports what docs/exports.md lists. Left out with a note: birefringence, pleochroism,
/// polarisation by faces, the lens, the invisible back of plane lights, the constant reflectance of
/// ideal mirrors. Throws InputError like `refuse_instruments`.
ExportedScene pbrt_scene(const Scene& scene, const std::string& stem);

}  // namespace culet
