#pragma once
// Light from all around that is looked up by direction only, as from a cube map in the stone's
// middle. Viewers in browsers treat a room like that.

#include "render/scene/scene.h"

namespace culet {

/// The light that arrives at the origin, as a map of all directions, `width` texels wide.
EnvironmentMap light_at_origin(const Lights& lights, int width);

/// A wall with two lit windows, perpendicular to x, at that distance from the origin. Its size
/// grows with the distance so that it looks the same from the origin.
Lights windows_at(double distance);

/// The error of the picture lit by the map against that lit by the lights themselves: mean over the
/// stone's pixels, relative to their mean.
double cube_map_error(const Scene& scene, const Lights& lights, int map_width);

}  // namespace culet
