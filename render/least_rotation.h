#pragma once
// The rotation that turns one direction into another and nothing else.

#include <glm/geometric.hpp>

#include "stone/solid.h"

namespace culet {

/// `v` after the least rotation that turns the unit `from` into the unit `to` (Rodrigues). Where
/// they are opposite there is no such rotation: half a turn about a fixed axis.
inline Vec3 turned_with(const Vec3& from, const Vec3& to, const Vec3& v) {
    const Vec3 sum = from + to;
    const double half = 0.5 * glm::dot(sum, sum);  // 1 + cosine
    if (!(half > 1e-30)) return v - 2 * glm::dot(from, v) * from;
    return v - glm::dot(sum, v) / half * sum + 2 * glm::dot(from, v) * to;
}

}  // namespace culet
