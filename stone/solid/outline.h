#pragma once
// A facet's outline as a polygon in its plane.

#include <vector>

#include "stone/solid/exact_sides.h"
#include "stone/solid/solid.h"

namespace culet {

/// Three corners of a facet that define its plane well, in the outline's order: the ends of a long
/// distance across it and the corner furthest from their line.
struct CornerTriple {
    Vec3 a{0, 0, 0}, b{0, 0, 0}, c{0, 0, 0};
    double width = 0;  ///< distance of c (the third one chosen) from the line of the other two
};
CornerTriple spread_corners(const Solid& solid, const Facet& facet);

/// The corners projected along the axis that the facet faces most, counter-clockwise when the facet
/// is. Dropping a coordinate rounds nothing, so side tests stay exact.
std::vector<Vec2> flat_outline(const Solid& solid, const Facet& facet, const Vec3& normal);

/// True if convex, wound once and counter-clockwise. Corners may be dented by up to `allowance` (a
/// length in the projection; 0: exact).
bool is_convex_outline(const std::vector<Vec2>& outline, double allowance);

/// True if two edges that are not neighbours touch, or neighbours overlap.
bool crosses_itself(const std::vector<Vec2>& outline);

}  // namespace culet
