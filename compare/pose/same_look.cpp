#include "compare/pose/same_look.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "stone/units.h"

namespace culet {

namespace {

// Real stones are 0.6 to 0.9 degrees from their symmetric ideals, azimuths of steep facets more.
constexpr double k_alike_deg = 5;
constexpr double k_alike_area = 2.5;
constexpr double k_alike_share = 0.85;

}  // namespace

glm::dmat3 mirrored_turn(const glm::dmat3& turn) {
    const glm::dmat3 left_to_right(-1, 0, 0, 0, 1, 0, 0, 0, 1);
    return left_to_right * turn * left_to_right;
}

bool look_alike(const WireSolid& wire, const StoneView& a, const StoneView& b, bool mirrored) {
    glm::dmat3 flip(1);
    if (mirrored) flip[0][0] = -1;
    const glm::dmat3 other_from_one = glm::transpose(b.turn) * flip * a.turn;
    const EyePlace eye = eye_of(a);
    double alike = 0, all = 0;
    for (const Facet& facet : wire.solid.facets) {
        if (!eye.sees(facet.plane)) continue;
        const double size = area(wire.solid, facet);
        all += size;
        const Vec3 there = other_from_one * facet.plane.normal;
        for (const Facet& other : wire.solid.facets) {
            if (glm::dot(there, other.plane.normal) < std::cos(radians(k_alike_deg))) continue;
            const double ratio = area(wire.solid, other) / size;
            if (ratio > k_alike_area || ratio < 1 / k_alike_area) continue;
            alike += size;
            break;
        }
    }
    return alike >= k_alike_share * all;
}

}  // namespace culet
