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
// Far above the rounding of a mesh file, far below what a photograph can show.
constexpr double k_equal_deg = 0.01, k_equal_area = 1.002;

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

/// Share of the area that the camera sees whose facets have counterparts.
double share_alike(const WireSolid& wire, const StoneView& seen, const glm::dmat3& turn,
                   double angle, double area_ratio) {
    const EyePlace eye = eye_of(seen);
    double alike = 0, all = 0;
    for (const Facet& facet : wire.solid.facets) {
        if (!eye.sees(facet.plane)) continue;
        const double size = area(wire.solid, facet);
        all += size;
        const Vec3 there = turn * facet.plane.normal;
        for (const Facet& other : wire.solid.facets) {
            if (glm::dot(there, other.plane.normal) < std::cos(angle)) continue;
            const double ratio = area(wire.solid, other) / size;
            if (ratio > area_ratio || ratio < 1 / area_ratio) continue;
            alike += size;
            break;
        }
    }
    return all > 0 ? alike / all : 0;
}

}  // namespace

bool look_alike(const WireSolid& wire, const StoneView& a, const StoneView& b, bool mirrored) {
    return share_alike(wire, a, other_from_one(a, b, mirrored), radians(k_alike_deg),
                       k_alike_area) >= k_alike_share;
}

bool look_equal(const WireSolid& wire, const StoneView& a, const StoneView& b, bool mirrored,
                double slack) {
    // The symmetry that is nearest to the turn between the views: facets' normals onto the nearest
    // counterparts (Wahba 1965), which for an exact symmetry is exact.
    const glm::dmat3 turn = other_from_one(a, b, mirrored);
    glm::dmat3 sum(0);
    for (const Facet& facet : wire.solid.facets) {
        const Vec3 there = turn * facet.plane.normal;
        const Facet* nearest = nullptr;
        double most = std::cos(slack);
        for (const Facet& other : wire.solid.facets) {
            const double cosine = glm::dot(there, other.plane.normal);
            if (cosine <= most) continue;
            most = cosine;
            nearest = &other;
        }
        if (nearest == nullptr) return false;
        sum +=
            area(wire.solid, facet) * glm::outerProduct(nearest->plane.normal, facet.plane.normal);
    }
    // The orthogonal factor of the polar decomposition (Higham 1986).
    glm::dmat3 factor = sum * (1 / std::cbrt(std::abs(glm::determinant(sum)) + 1e-300));
    for (int i = 0; i < 30; ++i) factor = 0.5 * (factor + glm::inverse(glm::transpose(factor)));
    return share_alike(wire, a, factor, radians(k_equal_deg), k_equal_area) > 1 - 1e-9;
}

}  // namespace culet
