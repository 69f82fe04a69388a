#pragma once
// Writes scenes for Mitsuba 3 (XML), to check pictures and to use its integrators.

#include <string>

#include "render/export/scene_parts.h"

namespace culet {

/// Keeps the scene's frame and lengths. `stem`: of the scene's file; the names of meshes and of the
/// map of distant lights, written beside it, start with it.
///
/// Exports what docs/exports.md lists. Left out with a note: birefringence, dispersion (Mitsuba's
/// dielectric has one index, here the mean at the sodium line or at the scene's only wavelength),
/// polarisation by faces, spectra beyond RGB, the lens, the invisible back of plane lights. Throws
/// InputError like `refuse_instruments`.
ExportedScene mitsuba_scene(const Scene& scene, const std::string& stem);

}  // namespace culet
