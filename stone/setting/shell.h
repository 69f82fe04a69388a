#pragma once
// Closed shells of triangles: wires and collars.

#include <array>
#include <vector>

#include "stone/solid/plan.h"
#include "stone/solid/solid.h"

namespace culet {

/// Triangles that run counter-clockwise as seen from outside.
struct Shell {
    std::vector<Vec3> vertices;
    std::vector<std::array<int, 3>> triangles;
};

/// A round wire along `path`, which lies in a plane of unit normal `aside`, with a half ball at
/// each end. No vertex is further than `radius` from the path, and each round has vertices that are
/// as far, on both sides in the plane. `sides` is a multiple of 4.
Shell round_wire(const std::vector<Vec3>& path, double radius, const Vec3& aside, int sides);

/// The same along a closed path that runs counter-clockwise about `aside`; corners are mitred, so
/// that the wire is as thick beside them as elsewhere.
Shell closed_wire(const std::vector<Vec3>& path, double radius, const Vec3& aside, int sides);

/// A collar: its section at corner k of `outline` has the points (x outward from the outline, y
/// up) of `section`, which is counter-clockwise.
Shell swept_collar(const PlanOutline& outline, const std::vector<PlanPoint>& section);

/// Each edge has two triangles, which run along it in opposite ways.
bool is_closed(const Shell& shell);

}  // namespace culet
