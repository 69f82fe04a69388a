#pragma once
// A scene for PBRT-v4, for a second opinion on its picture that keeps spectra.

#include <string>

#include "render/export/scene_parts.h"

namespace culet {

/// Unit direction at a place of PBRT's square maps of all directions, 0..1 from the left and from
/// the top: the equal-area octahedral mapping (Clarberg 2008; Pharr, Jakob & Humphreys
/// 2023, 3.8.3), +z in the middle, -z in the corners.
Vec3 equal_area_direction(double x, double y);

/// Frame and lengths are the scene's; PBRT's camera is left-handed and turned over. `stem`: of the
/// scene's file; the map of the distant lights stands beside it under a name that begins so.
///
/// Carried: stones as meshes of smooth dielectrics with the mean index and the mean absorption as
/// spectra, cameras but for the lens, objects, near lights as area lights, distant lights as a map.
/// Left out with a note: double refraction, pleochroism, polarisation by the faces, the lens, that
/// plane lights are not there from behind, ideal mirrors' constant reflectance. Throws InputError
/// as `refuse_instruments` does.
ExportedScene pbrt_scene(const Scene& scene, const std::string& stem);

}  // namespace culet
