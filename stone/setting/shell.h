#pragma once
// Closed shells of triangles: wires and collars.

#include <array>
#include <vector>

#include "stone/solid/plan.h"
#include "stone/solid/solid.h"

namespace culet {

/// Triangles are counter-clockwise as seen from outside.
struct Shell {
    std::vector<Vec3> vertices;
    std::vector<std::array<int, 3>> triangles;
};

/// A round wire along `path`, in a plane with unit normal `aside`, with a half ball at each end. No
/// vertex is further than `radius` from the path; every ring has vertices at that distance on both
/// sides in the plane. `sides` is a multiple of 4.
Shell round_wire(const std::vector<Vec3>& path, double radius, const Vec3& aside, int sides);

/// The same along a closed path, counter-clockwise about `aside`, with mitred corners that keep the
/// wire's thickness.
Shell closed_wire(const std::vector<Vec3>& path, double radius, const Vec3& aside, int sides);

/// A collar along `outline`. Its section at each corner is the counter-clockwise polygon `section`
/// (x outward from the outline, y up).
Shell swept_collar(const PlanOutline& outline, const std::vector<PlanPoint>& section);

/// True if each edge has two triangles, in opposite directions.
bool is_closed(const Shell& shell);

}  // namespace culet
