#include "compare/calibration/facet_error.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "compare/scores/chance.h"
#include "stone/numbers/units.h"
#include "stone/solid/checks.h"

namespace culet {

namespace {

const double k_near_normal = std::cos(radians(3.0));
constexpr double k_near_offset = 0.03;  // of the diameter
constexpr double k_rounding = 1e-9;     // of the diameter
constexpr int k_most_turns = 16;

std::optional<Solid> solid_of(const std::vector<NamedPlane>& planes) {
    HalfSpaceSolid cut = intersect_half_spaces(planes);
    if (cut.empty || !cut.bounded || cut.solid.facets.size() < 4) return std::nullopt;
    return std::move(cut.solid);
}

Plane mapped(const Plane& plane, const glm::dmat3& map) {
    // About the origin, through which the caller has put the axis.
    return {map * plane.normal, plane.offset};
}

struct Pairing {
    std::vector<int> to;  // facet f goes near facet to[f]
};

std::optional<Pairing> pairing(const std::vector<Plane>& planes, const glm::dmat3& map,
                               double size) {
    Pairing result;
    std::vector<bool> taken(planes.size(), false);
    for (const Plane& plane : planes) {
        const Plane there = mapped(plane, map);
        int nearest = -1;
        double best = k_near_normal;
        for (std::size_t j = 0; j < planes.size(); ++j) {
            const double along = glm::dot(there.normal, planes[j].normal);
            if (taken[j] || along < best) continue;
            if (std::abs(there.offset - planes[j].offset) > k_near_offset * size) continue;
            best = along;
            nearest = static_cast<int>(j);
        }
        if (nearest < 0) return std::nullopt;
        taken[static_cast<std::size_t>(nearest)] = true;
        result.to.push_back(nearest);
    }
    return result;
}

// Planes relative to an axis through the stone's middle, parallel to `up`.
struct Centred {
    std::vector<Plane> planes;
    Vec3 middle{0};
    double size = 0;
};

Centred centred(const Solid& solid) {
    Centred result;
    result.middle = centroid(solid);
    result.size = diameter(solid);
    for (const Facet& facet : solid.facets) {
        result.planes.push_back(
            {facet.plane.normal, facet.plane.offset - glm::dot(facet.plane.normal, result.middle)});
    }
    return result;
}

glm::dmat3 mirror_across(const Vec3& normal) {
    return glm::dmat3(1) - 2.0 * glm::outerProduct(normal, normal);
}

// The facet's plane rotated about an axis in it, at the angle `turn`, through the mean of its
// corners.
NamedPlane tilted(const Solid& solid, const Facet& facet, double turn, double angle) {
    const Vec3& n = facet.plane.normal;
    const Vec3 away = std::abs(n.z) < 0.9 ? Vec3(0, 0, 1) : Vec3(1, 0, 0);
    const Vec3 u = glm::normalize(glm::cross(n, away)), v = glm::cross(n, u);
    const Vec3 axis = std::cos(turn) * u + std::sin(turn) * v;
    const Vec3 normal = rotation_about(axis, angle) * n;
    return {facet.name, {normal, glm::dot(normal, corner_mean(solid, facet))}};
}

}  // namespace

std::optional<Solid> with_facet_error(const Solid& solid, double rms, std::uint64_t seed) {
    if (!is_convex(solid)) return std::nullopt;
    Chance chance(seed);
    std::vector<double> tilts, turns;
    double squares = 0;
    for (std::size_t k = 0; k < solid.facets.size(); ++k) {
        tilts.push_back(chance.normal());
        turns.push_back(2 * std::numbers::pi * chance.uniform());
        squares += tilts.back() * tilts.back();
    }
    const double unit = std::sqrt(squares / static_cast<double>(tilts.size()));
    std::vector<NamedPlane> planes;
    for (std::size_t k = 0; k < tilts.size(); ++k) {
        planes.push_back(tilted(solid, solid.facets[k], turns[k], rms / unit * tilts[k]));
    }
    return solid_of(planes);
}

std::optional<Solid> with_facet_tilted(const Solid& solid, std::size_t facet, int axis,
                                       double angle) {
    if (!is_convex(solid)) return std::nullopt;
    std::vector<NamedPlane> planes;
    for (const Facet& one : solid.facets) planes.push_back({one.name, one.plane});
    planes[facet] = tilted(solid, solid.facets[facet], axis * std::numbers::pi / 2, angle);
    return solid_of(planes);
}

int turns_alike(const Solid& solid, const Vec3& up) {
    const Centred stone = centred(solid);
    for (int n = k_most_turns; n >= 2; --n) {
        if (pairing(stone.planes, rotation_about(up, 2 * std::numbers::pi / n), stone.size)) {
            return n;
        }
    }
    return 1;
}

std::optional<Solid> symmetrised(const Solid& solid, const Vec3& up) {
    if (!is_convex(solid)) return std::nullopt;
    const Centred stone = centred(solid);
    const int n = turns_alike(solid, up);
    std::vector<glm::dmat3> group;
    for (int k = 0; k < n; ++k) {
        group.push_back(rotation_about(up, 2 * std::numbers::pi * k / n));
    }
    // Mirror planes of a cut pass through the middle of some facet, so each facet's azimuth is
    // tried.
    for (const Plane& plane : stone.planes) {
        const Vec3 across = plane.normal - glm::dot(plane.normal, up) * up;
        if (glm::length(across) < 0.05) continue;
        const glm::dmat3 mirror = mirror_across(glm::normalize(glm::cross(up, across)));
        if (!pairing(stone.planes, mirror, stone.size)) continue;
        const std::size_t turns = group.size();
        for (std::size_t k = 0; k < turns; ++k) group.push_back(group[k] * mirror);
        break;
    }
    if (group.size() < 2) return std::nullopt;

    // Each plane becomes the mean of all planes that the group maps onto it.
    std::vector<Plane> sums(stone.planes.size(), Plane{Vec3(0), 0});
    std::vector<double> counts(stone.planes.size(), 0);
    for (const glm::dmat3& map : group) {
        const auto pairs = pairing(stone.planes, map, stone.size);
        if (!pairs) continue;
        for (std::size_t f = 0; f < stone.planes.size(); ++f) {
            const auto j = static_cast<std::size_t>(pairs->to[f]);
            const Plane there = mapped(stone.planes[f], map);
            sums[j].normal += there.normal;
            sums[j].offset += there.offset;
            ++counts[j];
        }
    }
    std::vector<NamedPlane> planes;
    double largest_change = 0;
    for (std::size_t f = 0; f < stone.planes.size(); ++f) {
        const Vec3 normal = glm::normalize(sums[f].normal);
        const double offset = sums[f].offset / counts[f] + glm::dot(normal, stone.middle);
        largest_change = std::max(largest_change, glm::length(normal - stone.planes[f].normal));
        planes.push_back({solid.facets[f].name, {normal, offset}});
    }
    if (largest_change < radians(0.01)) return std::nullopt;
    auto result = solid_of(planes);
    // Symmetrised planes meet in one point up to rounding error: join corners that split.
    if (result) result = contract_near_meets(*result, k_rounding * stone.size).solid;
    return result;
}

}  // namespace culet
