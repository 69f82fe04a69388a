#pragma once
// Intersection of rays with analytic shapes, without an epsilon: a ray that starts on a surface
// says so, and does not hit it again at its start, whatever the rounding.

#include <optional>

#include "render/scene/objects.h"

namespace culet {

struct ShapeHit {
    double distance = 0;
    Vec3 normal{0, 0, 1};  ///< unit, outwards; of planes and discs as specified
    int part = 0;          ///< face of a box: 2 axis + (1 on its positive side)
};

/// Nearest hit from `origin` along the unit `direction`. `start`: the part of this shape that the
/// origin lies on; -1: it lies elsewhere.
std::optional<ShapeHit> nearest_on(const SphereShape& sphere, const Vec3& origin,
                                   const Vec3& direction, int start);
std::optional<ShapeHit> nearest_on(const PlaneShape& plane, const Vec3& origin,
                                   const Vec3& direction, int start);
std::optional<ShapeHit> nearest_on(const DiscShape& disc, const Vec3& origin, const Vec3& direction,
                                   int start);
std::optional<ShapeHit> nearest_on(const BoxShape& box, const Vec3& origin, const Vec3& direction,
                                   int start);

/// Moves a point near the surface onto it.
Vec3 on_surface(const SphereShape& sphere, const Vec3& point, int part);
Vec3 on_surface(const PlaneShape& plane, const Vec3& point, int part);
Vec3 on_surface(const DiscShape& disc, const Vec3& point, int part);
Vec3 on_surface(const BoxShape& box, const Vec3& point, int part);

}  // namespace culet
