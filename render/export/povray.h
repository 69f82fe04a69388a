#pragma once
// A scene in the language of POV-Ray 3.7, for a second opinion on its picture.
//
// What POV-Ray then computes is the tree of light paths of an isotropic stone under Snell and
// unpolarised Fresnel at every face, of the same eye rays: culet's picture with effects = "none",
// or with absorption. The level of a ray counts from the eye ray, 1, and the ray that leaves after
// K inner hits has level K + 2, so that culet's depth d (d - 1 inner segments) is max_trace_level
// d + 1. (POV-Ray's source, version 3.7: its `reflection { 0, 1 fresnel }` takes the interior's
// index and is 1 beyond the critical angle, `conserve_energy` gives the rest to the refracted ray,
// and cut rays are black.)

#include "render/export/scene_parts.h"

namespace culet {

/// Frame: POV-Ray's is left-handed with y up, so y and z change places; lengths are multiplied by a
/// power of two, because POV-Ray takes no hit nearer than 1e-4 of its units.
///
/// Carried: convex and other stones as `mesh2` (POV-Ray holds corners and normals in single
/// precision), the refractive index over that of the immersion, absorption, orthographic and
/// perspective cameras, objects, constant, lobe, hemisphere, cap, sphere and plane lights, colours
/// as RGB. Left out with a note: polarisation by the faces, double refraction, dispersion, spectra
/// beyond RGB, the lens, the level that the back of a plane light takes up, light on diffuse
/// objects and how metals reflect at a slant (povray_objects.h). Throws InputError where no picture
/// of sense would be left: polarised lights, optics before the eye, conoscopes, environment maps, a
/// plane light seen from behind, and what the renderer refuses.
ExportedScene povray_scene(const Scene& scene);

}  // namespace culet
