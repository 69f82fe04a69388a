#pragma once
// The body that planes enclose; its corners are functions of the planes. Private to the room.

#include <array>
#include <span>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

struct PlaneBody {
    std::vector<Vec3> corners;
    std::vector<std::array<int, 3>> planes;  ///< three planes of each corner: those most nearly
                                             ///< perpendicular
    std::vector<bool> present;               ///< by plane: it has a facet
    Solid solid;                             ///< the same body; facets are named by plane numbers
    bool closed = false;
};

PlaneBody enclosed_body(std::span<const Plane> planes);

/// Two unit directions perpendicular to a unit normal.
std::array<Vec3, 2> tilts_of(const Vec3& normal);

/// d(corner) = sum over its three planes of along[i] * (d(offset_i) - d(normal_i) . corner).
struct CornerSlopes {
    std::array<Vec3, 3> along{};
};
CornerSlopes corner_slopes(std::span<const Plane> planes, const std::array<int, 3>& crossing);

}  // namespace culet
