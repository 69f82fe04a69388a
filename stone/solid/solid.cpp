#include "stone/solid/solid.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace culet {

double height_above(const Plane& plane, const Vec3& point) {
    return glm::dot(plane.normal, point) - plane.offset;
}

int find_facet(const Solid& solid, std::string_view name) {
    for (std::size_t i = 0; i < solid.facets.size(); ++i) {
        if (solid.facets[i].name == name) return static_cast<int>(i);
    }
    return -1;
}

double diameter(const Solid& solid) {
    if (solid.vertices.empty()) return 0;
    Vec3 low = solid.vertices.front(), high = low;
    for (const Vec3& v : solid.vertices) {
        low = glm::min(low, v);
        high = glm::max(high, v);
    }
    const Vec3 middle = 0.5 * low + 0.5 * high;
    double radius = 0;
    for (const Vec3& v : solid.vertices) radius = std::max(radius, glm::length(v - middle));
    return 2 * radius;
}

double width_along(const Solid& solid, const Vec3& direction) {
    const double length = glm::length(direction);
    if (solid.vertices.empty() || !(length > 0)) return 0;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3& v : solid.vertices) {
        const double along = glm::dot(v, direction) / length;
        low = std::min(low, along);
        high = std::max(high, along);
    }
    return high - low;
}

namespace {

// Sums over tetrahedra from a corner of the solid; from the origin, a distant stone would lose
// digits.
struct VolumeMoments {
    double six_volumes = 0;
    Vec3 weighted{0, 0, 0};  // 24 times the first moment about the reference corner
    Vec3 reference{0, 0, 0};
};

// From the two shorter edges: in a needle, the product of two long ones would be a difference of
// numbers larger by its aspect ratio.
Vec3 twice_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, bc = c - b, ca = a - c;
    const double of_ab = glm::dot(ab, ab), of_bc = glm::dot(bc, bc), of_ca = glm::dot(ca, ca);
    if (of_ca >= of_ab && of_ca >= of_bc) return glm::cross(ab, bc);
    if (of_ab >= of_bc) return glm::cross(bc, ca);
    return glm::cross(ca, ab);
}

VolumeMoments volume_moments(const Solid& solid) {
    VolumeMoments sum;
    if (solid.vertices.empty()) return sum;
    sum.reference = solid.vertices.front();
    for (const Facet& facet : solid.facets) {
        for (std::size_t i = 1; i + 1 < facet.corners.size(); ++i) {
            const Vec3 a = solid.vertices[facet.corners[0]] - sum.reference;
            const Vec3 b = solid.vertices[facet.corners[i]] - sum.reference;
            const Vec3 c = solid.vertices[facet.corners[i + 1]] - sum.reference;
            const double six = glm::dot(a, twice_area(a, b, c));
            sum.six_volumes += six;
            sum.weighted += six * (a + b + c);
        }
    }
    return sum;
}

}  // namespace

double volume(const Solid& solid) {
    return volume_moments(solid).six_volumes / 6;
}

Vec3 centroid(const Solid& solid) {
    const VolumeMoments sum = volume_moments(solid);
    if (sum.six_volumes == 0) return sum.reference;
    return sum.reference + sum.weighted / (4 * sum.six_volumes);
}

double area(const Solid& solid, const Facet& facet) {
    Vec3 twice{0, 0, 0};
    for (std::size_t i = 1; i + 1 < facet.corners.size(); ++i) {
        const Vec3& origin = solid.vertices[facet.corners[0]];
        twice += glm::cross(solid.vertices[facet.corners[i]] - origin,
                            solid.vertices[facet.corners[i + 1]] - origin);
    }
    return 0.5 * glm::length(twice);
}

double narrow_width(const Solid& solid, const Facet& facet) {
    double longest = 0;
    for (const int a : facet.corners) {
        for (const int b : facet.corners) {
            longest = std::max(longest, glm::length(solid.vertices[std::size_t(a)] -
                                                    solid.vertices[std::size_t(b)]));
        }
    }
    return longest > 0 ? area(solid, facet) / longest : 0;
}

double angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

Vec3 corner_mean(const Solid& solid, const Facet& facet) {
    Vec3 sum{0, 0, 0};
    for (int corner : facet.corners) sum += solid.vertices[corner];
    return facet.corners.empty() ? sum : sum / static_cast<double>(facet.corners.size());
}

Plane plane_through(std::span<const Vec3> loop) {
    if (loop.empty()) return {Vec3{0, 0, 0}, 0};
    Vec3 mean{0, 0, 0};
    for (const Vec3& p : loop) mean += p / static_cast<double>(loop.size());
    Vec3 normal{0, 0, 0};
    for (std::size_t i = 0; i < loop.size(); ++i) {
        normal += glm::cross(loop[i] - mean, loop[(i + 1) % loop.size()] - mean);
    }
    const double length = glm::length(normal);
    if (!(length > 0)) return {Vec3{0, 0, 0}, 0};
    normal /= length;
    return {normal, glm::dot(normal, mean)};
}

double planarity(const Solid& solid) {
    double worst = 0;
    for (const Facet& facet : solid.facets) {
        for (int corner : facet.corners) {
            worst = std::max(worst, std::abs(height_above(facet.plane, solid.vertices[corner])));
        }
    }
    return worst;
}

int edge_count(const Solid& solid) {
    std::vector<std::pair<int, int>> edges;
    for (const Facet& facet : solid.facets) {
        for (std::size_t i = 0; i < facet.corners.size(); ++i) {
            edges.push_back(
                std::minmax({facet.corners[i], facet.corners[(i + 1) % facet.corners.size()]}));
        }
    }
    std::sort(edges.begin(), edges.end());
    return static_cast<int>(std::unique(edges.begin(), edges.end()) - edges.begin());
}

}  // namespace culet
