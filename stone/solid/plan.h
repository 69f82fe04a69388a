#pragma once
// Outlines seen from above, and how to offset them.

#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// A point of a plan; or of an upright section, with x outward and y up.
using PlanPoint = Vec2;

inline double cross(const PlanPoint& a, const PlanPoint& b) {
    return a.x * b.y - a.y * b.x;
}

/// Counter-clockwise; no two neighbours coincide; need not be convex.
using PlanOutline = std::vector<PlanPoint>;

/// The girdle of a stone whose z is up.
struct GirdleOutline {
    PlanOutline points;
    double height = 0;  ///< z of the section
};

/// The section where the stone is widest: the one of largest area, and for an upright girdle its
/// middle. Convex or not; of several loops the largest. Throws InputError for a solid without a
/// section.
GirdleOutline girdle_outline(const Solid& solid);

/// Negative for a clockwise outline.
double area_of(const PlanOutline& outline);

/// Convex hull (Andrew's monotone chain, 1979): indices of its corners, counter-clockwise, without
/// those that make a parallelogram of at most `least_area` with their neighbours.
std::vector<int> hull_corners(const std::vector<PlanPoint>& points, double least_area);
/// Its points, without those on straight edges.
PlanOutline convex_hull(const std::vector<PlanPoint>& points);

/// Moves the edges outward by `distance` (inward where negative) and intersects them in sharp
/// corners; point i is where corner i goes. Corners whose edges vanish go to one point (the edge
/// events of a straight skeleton, Aichholzer et al. 1995). Parts of an outline that run into each
/// other are not detected. Throws InputError where nothing is left.
PlanOutline moved_outline(const PlanOutline& outline, double distance);

double length_round(const PlanOutline& outline);

/// `middle_of`: centroid of the area. `inner_radius`: radius of the largest circle about it inside
/// a convex outline.
PlanPoint middle_of(const PlanOutline& outline);
double inner_radius(const PlanOutline& convex_outline);

/// Distance from a point to the outline; negative inside.
double distance_outside(const PlanOutline& outline, const PlanPoint& point);

/// Distance to where a ray first meets the outline, in lengths of `direction`; negative: it does
/// not.
double distance_along(const PlanOutline& outline, const PlanPoint& from,
                      const PlanPoint& direction);

}  // namespace culet
