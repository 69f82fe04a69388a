#pragma once
// Exact side tests for points given in doubles (CGAL's
// Exact_predicates_inexact_constructions_kernel). All points must be finite.

#include "stone/solid/solid.h"

namespace culet {

/// +1 when d lies above the plane through a, b, c (from where they appear counter-clockwise), -1
/// below, 0 exactly on it or when a, b, c lie on one line.
int side_of_plane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// +1 for a counter-clockwise turn, -1 clockwise, 0 on one line.
int turn(const Vec2& a, const Vec2& b, const Vec2& c);

bool segments_touch(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

}  // namespace culet
