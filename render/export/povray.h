#pragma once
// Writes scenes for POV-Ray 3.7, to check pictures.
//
// POV-Ray computes the tree of light paths of an isotropic stone with Snell's law and unpolarised
// Fresnel reflection, for the same eye rays: culet's picture with effects = "none", or with
// absorption. The eye ray has level 1, and the ray that exits after K inner hits has level K + 2,
// so culet's depth d (d - 1 inner segments) is max_trace_level d + 1. (In POV-Ray's source, version
// 3.7, `reflection { 0, 1 fresnel }` uses the interior's index and is 1 beyond the critical angle,
// `conserve_energy` gives the rest to the refracted ray, and cut rays are black.)

#include "render/export/scene_parts.h"

namespace culet {

/// POV-Ray's frame is left-handed with y up, so y and z are swapped. Lengths are multiplied by a
/// power of two, because POV-Ray ignores hits nearer than 1e-4 of its units. Stones are `mesh2`,
/// with corners and normals in single precision.
///
/// Exports what docs/exports.md lists. Left out with a note: polarisation by faces, birefringence,
/// dispersion, spectra beyond RGB, the lens, the level that the back of a plane light uses up,
/// light on diffuse objects, and the reflectance of metals at oblique incidence (povray_objects.h).
/// Throws InputError if no meaningful picture would remain (polarised lights, optics before the
/// eye, conoscopes, environment maps, a plane light seen from behind), and for scenes that the
/// renderer refuses.
ExportedScene povray_scene(const Scene& scene);

}  // namespace culet
