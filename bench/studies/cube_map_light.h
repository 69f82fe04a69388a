#pragma once
// Light looked up by direction only, as from a cube map in the stone's middle: viewers in browsers
// treat a room like that.

#include "render/scene/scene.h"

namespace culet {

/// The light that arrives at the origin, as a map of all directions, `width` texels wide.
EnvironmentMap light_at_origin(const Lights& lights, int width);

/// The wall is perpendicular to x at that distance, and as large as it must be to look the same
/// from the origin.
Lights windows_at(double distance);

/// The mean difference between the picture lit by the map and the one lit by the lights, over the
/// stone's pixels, relative to their mean.
double cube_map_error(const Scene& scene, const Lights& lights, int map_width);

}  // namespace culet
