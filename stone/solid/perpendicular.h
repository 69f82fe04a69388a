#pragma once
// Any direction perpendicular to a given one.

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "stone/solid/solid.h"

namespace culet {

/// A unit vector normal to `v` (not zero): its cross product with the coordinate axis that is most
/// nearly normal to it, so that no digits are lost.
inline Vec3 perpendicular_to(const Vec3& v) {
    const Vec3 size = glm::abs(v);
    Vec3 other{1, 0, 0};
    if (size.y <= size.x && size.y <= size.z) other = {0, 1, 0};
    if (size.z < size.x && size.z < size.y) other = {0, 0, 1};
    return glm::normalize(glm::cross(v, other));
}

}  // namespace culet
