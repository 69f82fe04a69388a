#pragma once
// The turn that stands a stone up.

#include <array>
#include <glm/geometric.hpp>

#include "stone/least_rotation.h"

namespace culet {

/// The least turn that brings the unit direction `up` to +z (half a turn about x for -z), by rows.
inline std::array<Vec3, 3> turn_to_z(const Vec3& up) {
    if (up == Vec3{0, 0, -1}) return {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, -1}};
    const Vec3 z{0, 0, 1};
    return {turned_with(z, up, {1, 0, 0}), turned_with(z, up, {0, 1, 0}), up};
}

/// A vector turned by a turn in rows, and turned back by it.
inline Vec3 times(const std::array<Vec3, 3>& rows, const Vec3& v) {
    return {glm::dot(rows[0], v), glm::dot(rows[1], v), glm::dot(rows[2], v)};
}
inline Vec3 times_transposed(const std::array<Vec3, 3>& rows, const Vec3& v) {
    return v.x * rows[0] + v.y * rows[1] + v.z * rows[2];
}

}  // namespace culet
