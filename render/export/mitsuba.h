#pragma once
// Writes scenes for Mitsuba 3 (XML), to check pictures and to use its integrators.

#include <string>

#include "render/export/scene_parts.h"

namespace culet {

/// Keeps the scene's frame and lengths. `stem`: of the scene's file; meshes and the map of distant
/// lights are written beside it, with names that start with it.
///
/// Exported: stones as meshes of smooth dielectrics with the mean index at the sodium line (or at
/// the scene's only wavelength) and an absorbing medium in RGB, cameras except the lens, objects,
/// near lights as area emitters, distant lights as a lat-long map. Left out with a note:
/// birefringence, dispersion (Mitsuba's dielectric has one index), polarisation by faces, spectra
/// beyond RGB, the lens, the invisible back of plane lights. Throws InputError like
/// `refuse_instruments`.
ExportedScene mitsuba_scene(const Scene& scene, const std::string& stem);

}  // namespace culet
