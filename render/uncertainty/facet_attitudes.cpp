#include "render/uncertainty/facet_attitudes.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace culet {

namespace {

FacetAttitude attitude_of(const Plane& plane, const Vec3& middle) {
    const double level = std::hypot(plane.normal.x, plane.normal.y);
    const double side = plane.normal.z < 0 ? -1 : 1;
    return {std::atan2(level, side * plane.normal.z),
            level > k_level_sine ? std::atan2(plane.normal.y, plane.normal.x) : 0, side,
            plane.offset - glm::dot(plane.normal, middle)};
}

Plane plane_of(const FacetAttitude& attitude, const Vec3& middle) {
    const double level = std::sin(attitude.inclination);
    const Vec3 normal{level * std::cos(attitude.azimuth), level * std::sin(attitude.azimuth),
                      attitude.side * std::cos(attitude.inclination)};
    return {normal, attitude.offset + glm::dot(normal, middle)};
}

}  // namespace

Vec3 mean_corner(const Solid& solid) {
    Vec3 sum(0);
    for (const Vec3& v : solid.vertices) sum += v;
    return sum / static_cast<double>(solid.vertices.size());
}

std::vector<FacetAttitude> attitudes_of(const Solid& solid, const Vec3& middle) {
    std::vector<FacetAttitude> attitudes;
    for (const Facet& facet : solid.facets) attitudes.push_back(attitude_of(facet.plane, middle));
    return attitudes;
}

std::optional<Solid> stone_of(const Solid& named, const std::vector<FacetAttitude>& attitudes,
                              const Vec3& middle) {
    std::vector<NamedPlane> planes;
    for (std::size_t f = 0; f < attitudes.size(); ++f)
        planes.push_back({named.facets[f].name, plane_of(attitudes[f], middle)});
    HalfSpaceSolid cut = intersect_half_spaces(planes);
    if (!cut.bounded || cut.empty) return std::nullopt;
    return std::move(cut.solid);
}

}  // namespace culet
