#pragma once
// The rotation that turns one direction into another and nothing else.

#include <glm/geometric.hpp>

#include "stone/solid/perpendicular.h"
#include "stone/solid/solid.h"

namespace culet {

/// `v` after the least rotation that turns the unit `from` into the unit `to`. Where they are
/// opposite there is no such rotation: half a turn about some axis across them.
///
/// As two reflections (Householder 1958), in `from` and in half of the way: lengths and angles are
/// kept to rounding however near to opposite the two are, where Rodrigues' formula loses them.
inline Vec3 turned_with(const Vec3& from, const Vec3& to, const Vec3& v) {
    const Vec3 sum = from + to, apart = from - to;
    const double length = glm::length(sum);
    Vec3 half_way = length > 0 ? sum / length : perpendicular_to(from);
    // Across what parts them, were their lengths the same to the last digit: where little is left
    // of the sum, that digit turns it. Twice is enough (Kahan, in Parlett 1980, 6.9).
    for (int time = 0; time < 2 && glm::dot(apart, apart) > length * length; ++time) {
        half_way -= glm::dot(half_way, apart) / glm::dot(apart, apart) * apart;
        const double left = glm::length(half_way);
        half_way = left > 0 ? half_way / left : perpendicular_to(from);
    }
    const Vec3 back = v - 2 * glm::dot(from, v) * from;
    return back - 2 * glm::dot(half_way, back) * half_way;
}

}  // namespace culet
