#pragma once
// Outlines seen from above, and how they are moved inward and outward.

#include <glm/vec2.hpp>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// A point of a plan, or of an upright section: x outward, y up.
using PlanPoint = glm::dvec2;

inline double cross(const PlanPoint& a, const PlanPoint& b) {
    return a.x * b.y - a.y * b.x;
}

/// Counter-clockwise, no two neighbours alike; it need not be convex.
using PlanOutline = std::vector<PlanPoint>;

/// The girdle of a stone whose z is up.
struct GirdleOutline {
    PlanOutline points;
    double height = 0;  ///< z of the section that is the outline
};

/// The section where the stone is widest: where its area is largest, and of a girdle that stands
/// upright the middle. Convex or not; of several loops the largest. Throws InputError for a solid
/// without a section.
GirdleOutline girdle_outline(const Solid& solid);

/// Convex hull (Andrew 1979), counter-clockwise, without points on straight edges.
PlanOutline convex_hull(std::vector<PlanPoint> points);

/// Edges moved outward by `distance` (inward where negative) and met in sharp corners. Point i is
/// where corner i goes; corners whose edges vanish on the way go to one point, so that the count
/// stays (the edge events of a straight skeleton, Aichholzer et al. 1995; parts of an outline that
/// run into each other across it are not told). Throws InputError where nothing is left.
PlanOutline moved_outline(const PlanOutline& outline, double distance);

/// Length of the way round.
double length_round(const PlanOutline& outline);

/// Radius of the largest circle inside a convex outline about its middle of area.
PlanPoint middle_of(const PlanOutline& outline);
double inner_radius(const PlanOutline& convex_outline);

/// Distance from a point to the outline, negative inside.
double distance_outside(const PlanOutline& outline, const PlanPoint& point);

/// Where a ray first meets the outline, in lengths of the direction; negative: nowhere.
double distance_along(const PlanOutline& outline, const PlanPoint& from,
                      const PlanPoint& direction);

}  // namespace culet
