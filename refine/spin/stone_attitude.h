#pragma once
// How a stone of unknown cut stands.

#include <array>
#include <vector>

#include "compare/turntable/edge_points.h"
#include "fit/silhouettes/turning_camera.h"
#include "stone/solid/solid.h"

namespace culet {

/// Axes of the upright stone.
struct StoneAttitude {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
};

/// z is the axis of half a turn that brings most of the `seen` facets onto others, near the
/// direction along which the outline's area is largest, or that direction if there is no such axis;
/// on the side of `up`. x is along the least width across z.
StoneAttitude attitude_of(const Solid& solid, const std::vector<bool>& seen, const Vec3& up);

/// With z as given.
StoneAttitude attitude_about(const Solid& solid, const Vec3& up);

/// Whether the facets that bound the stone on both sides were `seen`.
bool ends_are_seen(const Solid& solid, const std::vector<bool>& seen, const Vec3& along);

Solid upright(Solid solid, const StoneAttitude& attitude);

/// (u, v, w) = projection (X, 1): X of the upright stone falls on the pixel (u / w, v / w), the
/// first pixel's corner at (0, 0).
using Projection = std::array<std::array<double, 4>, 3>;
Projection projection_of(const PictureAxes& axes, const StoneAttitude& attitude,
                         const LevelPicture& picture);

}  // namespace culet
