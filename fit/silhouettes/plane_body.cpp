#include "fit/silhouettes/plane_body.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "stone/solid/perpendicular.h"

namespace culet {

namespace {

double squareness(std::span<const Plane> planes, int a, int b, int c) {
    return std::abs(
        glm::dot(planes[std::size_t(a)].normal,
                 glm::cross(planes[std::size_t(b)].normal, planes[std::size_t(c)].normal)));
}

std::array<int, 3> squarest_crossing(std::span<const Plane> planes, const std::vector<int>& at) {
    std::array<int, 3> best{at[0], at[1], at[2]};
    if (at.size() == 3) return best;
    double most = -1;
    for (std::size_t i = 0; i < at.size(); ++i) {
        for (std::size_t j = i + 1; j < at.size(); ++j) {
            for (std::size_t k = j + 1; k < at.size(); ++k) {
                const double square = squareness(planes, at[i], at[j], at[k]);
                if (square > most) {
                    most = square;
                    best = {at[i], at[j], at[k]};
                }
            }
        }
    }
    return best;
}

}  // namespace

PlaneBody enclosed_body(std::span<const Plane> planes) {
    std::vector<NamedPlane> named;
    named.reserve(planes.size());
    for (const Plane& plane : planes) named.push_back({std::to_string(named.size()), plane});
    PlaneBody body;
    body.present.assign(planes.size(), false);
    HalfSpaceSolid cut = intersect_half_spaces(named);
    if (!cut.bounded || cut.empty || cut.solid.facets.size() < 4) return body;
    body.closed = true;
    body.solid = std::move(cut.solid);
    body.corners = body.solid.vertices;
    std::vector<std::vector<int>> at(body.corners.size());
    for (const Facet& facet : body.solid.facets) {
        const int plane = std::stoi(facet.name);
        body.present[std::size_t(plane)] = true;
        for (const int c : facet.corners) at[std::size_t(c)].push_back(plane);
    }
    for (const std::vector<int>& crossing : at) {
        body.planes.push_back(squarest_crossing(planes, crossing));
    }
    return body;
}

std::array<Vec3, 2> tilts_of(const Vec3& normal) {
    const Vec3 t = perpendicular_to(normal);
    return {t, glm::cross(normal, t)};
}

CornerSlopes corner_slopes(std::span<const Plane> planes, const std::array<int, 3>& crossing) {
    const Vec3 &a = planes[std::size_t(crossing[0])].normal,
               &b = planes[std::size_t(crossing[1])].normal,
               &c = planes[std::size_t(crossing[2])].normal;
    // Columns of the inverse of the matrix whose rows are the normals.
    const double det = glm::dot(a, glm::cross(b, c));
    const double scale = std::abs(det) > 1e-12 ? 1 / det : 0;
    return {{scale * glm::cross(b, c), scale * glm::cross(c, a), scale * glm::cross(a, b)}};
}

}  // namespace culet
