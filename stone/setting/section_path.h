#pragma once
// The path of a wire beside a stone, in the upright section through a place of the girdle: x is
// outward from the place, y is up.

#include <vector>

#include "stone/setting/places.h"
#include "stone/solid/solid.h"

namespace culet {

/// Hull of what the wire may touch, from its lowest corner outward and up to its highest: the
/// stone's part between two planes `half_width` beside the place, projected onto the section. A
/// wire no wider that keeps a distance from the hull keeps it from the stone.
std::vector<PlanPoint> outer_hull(const Solid& solid, const GirdlePlace& place, double half_width);

/// The curve at `distance` outside an outer hull, from below its lowest to above its highest
/// corner. Corners are rounded with `steps` chords per full turn.
std::vector<PlanPoint> curve_beside(const std::vector<PlanPoint>& hull, double distance, int steps);

/// The shortest path (a taut string) from `from`, which lies outside, around the curve to where it
/// crosses x = `inside` on top. The second form ends in `to` instead.
std::vector<PlanPoint> taut_path(const std::vector<PlanPoint>& curve, const PlanPoint& from,
                                 double inside);
std::vector<PlanPoint> taut_path_between(const std::vector<PlanPoint>& curve, const PlanPoint& from,
                                         const PlanPoint& to);

/// The line with sharp corners at `distance` outside an outer hull, between its crossings of x =
/// `inside` below and above. No point of it is nearer to the hull.
std::vector<PlanPoint> line_beside(const std::vector<PlanPoint>& hull, double distance,
                                   double inside);

std::vector<PlanPoint> outer_hull_of(const std::vector<PlanPoint>& points);

}  // namespace culet
