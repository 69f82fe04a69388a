#include "page/facet_view.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <limits>

namespace culet {

namespace {

constexpr double k_margin = 12;
constexpr double k_least_facing = 0.01;  // sine of half a degree

// Rows: the directions right, up and towards the viewer in the stone's frame.
glm::dmat3 view_from_stone(ViewSide side) {
    switch (side) {
        case ViewSide::crown:
            break;
        case ViewSide::pavilion:
            return glm::transpose(glm::dmat3({-1, 0, 0}, {0, 1, 0}, {0, 0, -1}));
        case ViewSide::girdle:
            return glm::transpose(glm::dmat3({1, 0, 0}, {0, 0, 1}, {0, -1, 0}));
    }
    return glm::dmat3(1.0);
}

bool finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

FacetView view_of(const Solid& solid, ViewSide side, double size) {
    const glm::dmat3 view = view_from_stone(side);
    struct Placed {
        SeenFacet seen;
        double depth = 0;
    };
    std::vector<Placed> placed;
    glm::dvec2 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const Facet& facet = solid.facets[f];
        if (!((view * facet.plane.normal).z > k_least_facing)) continue;
        Placed one;
        one.seen.facet = static_cast<int>(f);
        for (const int corner : facet.corners) {
            if (corner < 0 || static_cast<std::size_t>(corner) >= solid.vertices.size()) continue;
            const Vec3& vertex = solid.vertices[static_cast<std::size_t>(corner)];
            if (!finite(vertex)) continue;
            const Vec3 at = view * vertex;
            one.seen.corners.emplace_back(at);
            one.depth += at.z;
        }
        if (one.seen.corners.size() < 3) continue;
        one.depth /= static_cast<double>(one.seen.corners.size());
        for (const auto& c : one.seen.corners) {
            low = glm::min(low, c);
            high = glm::max(high, c);
        }
        placed.push_back(std::move(one));
    }
    const double extent = placed.empty() ? 0 : std::max(high.x - low.x, high.y - low.y);
    if (!(extent > 0) || !std::isfinite(extent)) return {};
    std::stable_sort(placed.begin(), placed.end(),
                     [](const Placed& a, const Placed& b) { return a.depth < b.depth; });
    FacetView result;
    result.scale = (size - 2 * k_margin) / extent;
    result.width = result.scale * (high.x - low.x) + 2 * k_margin;
    result.height = result.scale * (high.y - low.y) + 2 * k_margin;
    result.origin = {k_margin - result.scale * low.x, k_margin + result.scale * high.y};
    for (Placed& one : placed) {
        for (auto& c : one.seen.corners) {
            c = {k_margin + result.scale * (c.x - low.x), k_margin + result.scale * (high.y - c.y)};
        }
        result.facets.push_back(std::move(one.seen));
    }
    return result;
}

}  // namespace culet
