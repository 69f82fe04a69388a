#include "stone/solid/angles.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace culet {

double inclination(const Vec3& normal, const Vec3& up) {
    // From both components: the arc cosine alone loses half its digits near the table.
    return std::atan2(glm::length(glm::cross(normal, up)), std::abs(glm::dot(normal, up)));
}

double azimuth(const Vec3& normal) {
    const double angle = std::atan2(normal.y, normal.x);
    if (angle >= 0) return angle + 0.0;  // avoids -0
    // A tiny negative angle plus a full turn rounds to the full turn.
    const double turned = angle + 2 * std::numbers::pi;
    return turned < 2 * std::numbers::pi ? turned : 0.0;
}

}  // namespace culet
