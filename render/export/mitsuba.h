#pragma once
// A scene for Mitsuba 3 (XML), for a second opinion on its picture and for its other integrators.

#include <string>

#include "render/export/scene_parts.h"

namespace culet {

/// Frame and lengths are the scene's. `stem`: of the scene's file; meshes and the map of the
/// distant lights stand beside it under names that begin so.
///
/// Carried: stones as meshes of smooth dielectrics with the mean index at the sodium line (or at
/// the scene's one wavelength) and an absorbing medium in RGB, cameras but for the lens, objects,
/// near lights as area emitters, distant lights as a lat-long map. Left out with a note: double
/// refraction, dispersion (Mitsuba's dielectric has one index), polarisation by the faces, spectra
/// beyond RGB, the lens, that plane lights are not there from behind. Throws InputError as
/// `refuse_instruments` does.
ExportedScene mitsuba_scene(const Scene& scene, const std::string& stem);

}  // namespace culet
