#pragma once
// Round brilliants by the formulas of gemstone-optimizer (J. Rembold, docs/SCIENCE.md 1), so that
// figures are comparable: radius 1, its conventions for star and lower lengths, 16 girdle facets.
// Facets T, C1.., S1.., U1a.., P1.., L1a.., G0...

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "stone/numbers/units.h"
#include "stone/solid/solid.h"

namespace culet::test {

struct RoundProportions {
    double table = 53, crown = 34.5, pavilion = 40.75, star = 50, lower = 75, girdle = 3;
};

inline Plane plane_outwards(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    const double offset = glm::dot(normal, a);
    return offset < 0 ? Plane{-normal, -offset} : Plane{normal, offset};
}

inline Plane sloping(double slope, double azimuth, double side, double g) {
    return {{std::sin(slope) * std::cos(azimuth), std::sin(slope) * std::sin(azimuth),
             side * std::cos(slope)},
            std::sin(slope) + g * std::cos(slope)};
}

inline Solid round_brilliant(const RoundProportions& p = {}) {
    const double t = p.table / 100, g = p.girdle / 100, step = std::numbers::pi / 8;
    const double crown = radians(p.crown), pavilion = radians(p.pavilion);
    const double star = t * std::cos(step) + (1 - t * std::cos(step)) * p.star / 100;
    const double star_z = g + std::tan(crown) * (1 - star * std::cos(step));
    const double low = (1 - p.lower / 100) / std::cos(step);
    const double low_z = -g - std::tan(pavilion) * p.lower / 100;
    const double top = g + (1 - t) * std::tan(crown);
    const auto at = [](double r, double azimuth, double z) {
        return Vec3{r * std::cos(azimuth), r * std::sin(azimuth), z};
    };
    std::vector<NamedPlane> planes{{"T", {{0, 0, 1}, top}}};
    for (int i = 0; i < 8; ++i) {
        const double a = 2 * step * i, b = a + 2 * step, m = a + step;
        const std::string k = std::to_string(i + 1);
        const Vec3 s = at(star, m, star_z), l = at(low, m, low_z);
        planes.push_back({"C" + k, sloping(crown, a, 1, g)});
        planes.push_back({"S" + k, plane_outwards(at(t, a, top), at(t, b, top), s)});
        planes.push_back({"U" + k + "a", plane_outwards(at(1, a, g), at(1, m, g), s)});
        planes.push_back({"U" + k + "b", plane_outwards(at(1, m, g), at(1, b, g), s)});
        planes.push_back({"P" + k, sloping(pavilion, a, -1, g)});
        planes.push_back({"L" + k + "a", plane_outwards(at(1, a, -g), l, at(1, m, -g))});
        planes.push_back({"L" + k + "b", plane_outwards(at(1, m, -g), l, at(1, b, -g))});
        for (const double z : {a + step / 2, m + step / 2})
            planes.push_back({"G" + std::to_string(planes.size()),
                              {{std::cos(z), std::sin(z), 0}, std::cos(step / 2)}});
    }
    return contract_near_meets(intersect_half_spaces(planes).solid, 1e-9).solid;
}

/// With one facet made steeper by so many degrees, about its middle.
inline Solid with_error(const Solid& solid, const std::string& name, double steeper_deg) {
    std::vector<NamedPlane> planes;
    for (const Facet& facet : solid.facets) {
        Plane plane = facet.plane;
        if (facet.name == name) {
            const double side = plane.normal.z < 0 ? -1 : 1;
            const double level = std::hypot(plane.normal.x, plane.normal.y);
            const double slope = std::atan2(level, side * plane.normal.z) + radians(steeper_deg);
            const double azimuth = std::atan2(plane.normal.y, plane.normal.x);
            plane.normal = {std::sin(slope) * std::cos(azimuth),
                            std::sin(slope) * std::sin(azimuth), side * std::cos(slope)};
            plane.offset = glm::dot(plane.normal, corner_mean(solid, facet));
        }
        planes.push_back({facet.name, plane});
    }
    return intersect_half_spaces(planes).solid;
}

}  // namespace culet::test
