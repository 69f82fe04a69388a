#pragma once
// The path of a wire beside a stone, in the upright section through a place of the girdle: x is
// outward from the place, y is up.

#include <vector>

#include "stone/setting/places.h"
#include "stone/solid/solid.h"

namespace culet {

/// The convex hull of what the wire may come near, from its lowest corner outward and up to its
/// highest: the stone's part between two planes `half_width` beside the place, moved into the
/// section. Nothing of that part lies beyond the hull, so a wire no wider that keeps a distance
/// from the hull keeps it from the stone.
std::vector<PlanPoint> outer_hull(const Solid& solid, const GirdlePlace& place, double half_width);

/// The curve at `distance` outside an outer hull, its corners rounded with `steps` chords a full
/// turn, from straight below the lowest corner to straight above the highest.
std::vector<PlanPoint> curve_beside(const std::vector<PlanPoint>& hull, double distance, int steps);

/// The shortest way from `from`, which lies outside, round the curve to where it comes inside
/// x = `inside` on top (a string pulled taut); `to` instead, where given.
std::vector<PlanPoint> taut_path(const std::vector<PlanPoint>& curve, const PlanPoint& from,
                                 double inside);
std::vector<PlanPoint> taut_path_between(const std::vector<PlanPoint>& curve, const PlanPoint& from,
                                         const PlanPoint& to);

/// The sharp-cornered line at `distance` outside an outer hull, from where it comes inside
/// x = `inside` below to where it does so above. No point of it is nearer to the hull.
std::vector<PlanPoint> line_beside(const std::vector<PlanPoint>& hull, double distance,
                                   double inside);

/// The outer hull of points (x outward, y up).
std::vector<PlanPoint> outer_hull_of(const std::vector<PlanPoint>& points);

}  // namespace culet
