#pragma once
// Light from all around looked up by direction alone, as from a cube map in the stone's middle:
// what viewers in a browser do with a room.

#include "render/scene/scene.h"

namespace culet {

/// The light that arrives at the origin, as a map of all directions, that many texels wide.
EnvironmentMap light_at_origin(const Lights& lights, int width);

/// A wall with two lit windows, square to x, at that distance from the origin; it and its windows
/// are as large as they must be to look the same from the origin at every distance.
Lights windows_at(double distance);

/// How far the picture in the map is off that in the lights themselves: mean over the stone's
/// pixels, over their mean.
double cube_map_error(const Scene& scene, const Lights& lights, int map_width);

}  // namespace culet
