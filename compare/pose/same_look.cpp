#include "compare/pose/same_look.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "stone/numbers/units.h"

namespace culet {

namespace {

// Real stones are 0.6 to 0.9 degrees off their symmetric ideals, azimuths of steep facets more.
constexpr double k_alike_deg = 5;
constexpr double k_alike_area = 2.5;
constexpr double k_alike_share = 0.85;
// Far above the rounding of a mesh file, far below what a photograph can show.
constexpr double k_equal = 1e-4, k_equal_area = 1.002;

}  // namespace

glm::dmat3 mirrored_turn(const glm::dmat3& turn) {
    const glm::dmat3 left_to_right(-1, 0, 0, 0, 1, 0, 0, 0, 1);
    return left_to_right * turn * left_to_right;
}

namespace {

glm::dmat3 other_from_one(const StoneView& a, const StoneView& b, bool mirrored) {
    glm::dmat3 flip(1);
    if (mirrored) flip[0][0] = -1;
    return glm::transpose(b.turn) * flip * a.turn;
}

/// The facet with the fewest others of its size, among those not parallel to `apart_from` (zero:
/// among all).
int rarest_facet(const WireSolid& wire, const std::vector<double>& areas, const Vec3& apart_from) {
    int rarest = -1;
    std::size_t fewest = areas.size() + 1;
    for (std::size_t f = 0; f < areas.size(); ++f) {
        const Vec3& normal = wire.solid.facets[f].plane.normal;
        if (glm::length(glm::cross(normal, apart_from)) < 0.1 && apart_from != Vec3(0)) continue;
        std::size_t count = 0;
        for (const double other : areas) {
            if (std::abs(other - areas[f]) <= (k_equal_area - 1) * areas[f]) ++count;
        }
        // Among equally rare ones the largest, whose size is most accurate.
        if (count < fewest ||
            (count == fewest && areas[f] > areas[static_cast<std::size_t>(rarest)])) {
            fewest = count;
            rarest = static_cast<int>(f);
        }
    }
    return rarest;
}

/// Orthonormal frame from two directions.
glm::dmat3 frame_of(const Vec3& a, const Vec3& b, bool mirrored) {
    const Vec3 across = glm::normalize(glm::cross(a, b));
    return {a, mirrored ? -across : across, glm::cross(across, a)};
}

bool is_symmetry(const WireSolid& wire, const std::vector<double>& areas, const glm::dmat3& turn) {
    for (std::size_t f = 0; f < areas.size(); ++f) {
        const Plane& plane = wire.solid.facets[f].plane;
        const Vec3 there = turn * plane.normal;
        const double offset = height_above(plane, wire.middle);
        const bool found = std::any_of(
            wire.solid.facets.begin(), wire.solid.facets.end(), [&](const Facet& other) {
                return glm::length(other.plane.normal - there) < k_equal &&
                       std::abs(height_above(other.plane, wire.middle) - offset) <
                           k_equal * wire.diameter;
            });
        if (!found) return false;
    }
    return true;
}

}  // namespace

bool look_alike(const WireSolid& wire, const StoneView& a, const StoneView& b, bool mirrored) {
    const glm::dmat3 turn = other_from_one(a, b, mirrored);
    const EyePlace eye = eye_of(a);
    double alike = 0, all = 0;
    for (const Facet& facet : wire.solid.facets) {
        if (!eye.sees(facet.plane)) continue;
        const double size = area(wire.solid, facet);
        all += size;
        const Vec3 there = turn * facet.plane.normal;
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

std::vector<glm::dmat3> symmetries_of(const WireSolid& wire) {
    std::vector<glm::dmat3> found{glm::dmat3(1)};
    std::vector<double> areas;
    for (const Facet& facet : wire.solid.facets) areas.push_back(area(wire.solid, facet));
    const auto normal = [&](std::size_t f) { return wire.solid.facets[f].plane.normal; };
    const int first = rarest_facet(wire, areas, Vec3(0));
    if (first < 0) return found;
    const Vec3 a = normal(static_cast<std::size_t>(first));
    const int second = rarest_facet(wire, areas, a);
    if (second < 0) return found;
    const Vec3 b = normal(static_cast<std::size_t>(second));
    // The images of these two facets determine the symmetry.
    for (std::size_t i = 0; i < areas.size(); ++i) {
        for (std::size_t j = 0; j < areas.size(); ++j) {
            if (std::abs(glm::dot(normal(i), normal(j)) - glm::dot(a, b)) > k_equal) continue;
            for (const bool mirrored : {false, true}) {
                const glm::dmat3 turn = frame_of(normal(i), normal(j), mirrored) *
                                        glm::transpose(frame_of(a, b, false));
                if (glm::length(turn[0] - Vec3(1, 0, 0)) + glm::length(turn[1] - Vec3(0, 1, 0)) <
                        k_equal &&
                    !mirrored)
                    continue;
                if (std::abs(areas[i] / areas[static_cast<std::size_t>(first)] - 1) >
                        k_equal_area - 1 ||
                    std::abs(areas[j] / areas[static_cast<std::size_t>(second)] - 1) >
                        k_equal_area - 1)
                    continue;
                if (is_symmetry(wire, areas, turn)) found.push_back(turn);
            }
        }
    }
    return found;
}

}  // namespace culet
