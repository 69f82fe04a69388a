#pragma once
// The least rotation that turns one direction into another.

#include <glm/geometric.hpp>

#include "stone/solid/perpendicular.h"
#include "stone/solid/solid.h"

namespace culet {

/// `v` after the least rotation from the unit `from` to the unit `to`; for opposite directions half
/// a turn about some perpendicular axis.
///
/// Two reflections (Householder 1958), in `from` and in the half-way direction, keep lengths and
/// angles to rounding even where the two are nearly opposite and Rodrigues' formula loses digits.
inline Vec3 turned_with(const Vec3& from, const Vec3& to, const Vec3& v) {
    const Vec3 sum = from + to, apart = from - to;
    const double length = glm::length(sum);
    Vec3 half_way = length > 0 ? sum / length : perpendicular_to(from);
    // Make half_way orthogonal to `apart`, as it would be if both lengths were exactly 1. Where
    // `sum` is small, the last digit of the lengths turns it. Twice is enough (Kahan, in Parlett
    // 1980, 6.9).
    for (int time = 0; time < 2 && glm::dot(apart, apart) > length * length; ++time) {
        half_way -= glm::dot(half_way, apart) / glm::dot(apart, apart) * apart;
        const double left = glm::length(half_way);
        half_way = left > 0 ? half_way / left : perpendicular_to(from);
    }
    const Vec3 back = v - 2 * glm::dot(from, v) * from;
    return back - 2 * glm::dot(half_way, back) * half_way;
}

}  // namespace culet
