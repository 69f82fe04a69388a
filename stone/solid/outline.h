#pragma once
// A facet's outline as a polygon of its plane.

#include <vector>

#include "stone/solid/exact_sides.h"
#include "stone/solid/solid.h"

namespace culet {

/// Three corners of a facet that fix its plane well, in the order of the outline: the two at the
/// ends of a long reach across it and the one furthest from their line.
struct CornerTriple {
    Vec3 a{0, 0, 0}, b{0, 0, 0}, c{0, 0, 0};
    double width = 0;  ///< of c (the third one chosen) from the line of the other two
};
CornerTriple spread_corners(const Solid& solid, const Facet& facet);

/// The corners seen along the axis that the facet faces most, so that they run counter-clockwise
/// when the facet does. Dropping a coordinate rounds nothing: sides stay exact.
std::vector<Vec2> flat_outline(const Solid& solid, const Facet& facet, const Vec3& normal);

/// Convex, wound once, and counter-clockwise. A corner may be dented by no more than `allowance`
/// (a length in the projection; 0: exact).
bool is_convex_outline(const std::vector<Vec2>& outline, double allowance);

/// Two edges that are no neighbours touch, or neighbours overlap.
bool crosses_itself(const std::vector<Vec2>& outline);

}  // namespace culet
