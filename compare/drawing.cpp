#include "compare/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <limits>

#include "compare/html.h"

namespace culet {

namespace {

constexpr double k_size = 1000;  // of the drawing's longer side, in its own units
constexpr double k_margin = 12;
constexpr double k_letter = 24;  // height of a name

// Rows: where right, up and towards the viewer lie in the stone.
glm::dmat3 view_from_stone(ViewSide side) {
    const double turned = side == ViewSide::crown ? 1 : -1;
    return glm::transpose(glm::dmat3({turned, 0, 0}, {0, 1, 0}, {0, 0, turned}));
}

struct Projected {
    int facet = 0;
    std::vector<glm::dvec2> corners;
};

bool finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::vector<Projected> facing(const Solid& solid, const glm::dmat3& view) {
    std::vector<Projected> result;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const Facet& facet = solid.facets[f];
        // Seen at under half a degree a facet is a line: girdle facets stay out of both views.
        if (!((view * facet.plane.normal).z > 0.01)) continue;
        Projected projected{static_cast<int>(f), {}};
        for (const int corner : facet.corners) {
            if (corner < 0 || static_cast<std::size_t>(corner) >= solid.vertices.size()) continue;
            const Vec3& vertex = solid.vertices[static_cast<std::size_t>(corner)];
            if (finite(vertex)) projected.corners.emplace_back(glm::dvec2(view * vertex));
        }
        if (projected.corners.size() >= 3) result.push_back(std::move(projected));
    }
    return result;
}

glm::dvec2 middle_of(const std::vector<glm::dvec2>& corners) {
    glm::dvec2 sum(0, 0);
    for (const auto& c : corners) sum += c;
    return sum / static_cast<double>(corners.size());
}

// Half the height that the outline leaves free above and below a point, the narrower of the two.
double room_around(const std::vector<glm::dvec2>& corners, const glm::dvec2& middle) {
    double room = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 a = corners[i], along = corners[(i + 1) % corners.size()] - a;
        const double length = glm::length(along);
        if (length <= 0) continue;
        const glm::dvec2 off = middle - a;
        room = std::min(room, std::abs(along.x * off.y - along.y * off.x) / length);
    }
    return room;
}

}  // namespace

std::string draw_facets_svg(const Solid& solid, ViewSide side,
                            const std::vector<FacetPaint>& paint) {
    std::vector<Projected> facets = facing(solid, view_from_stone(side));
    if (facets.empty()) return {};
    glm::dvec2 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
    for (const Projected& facet : facets) {
        for (const auto& c : facet.corners) {
            low = glm::min(low, c);
            high = glm::max(high, c);
        }
    }
    const double extent = std::max(high.x - low.x, high.y - low.y);
    if (!(extent > 0)) return {};
    const double scale = (k_size - 2 * k_margin) / extent;
    const double width = scale * (high.x - low.x) + 2 * k_margin;
    const double height = scale * (high.y - low.y) + 2 * k_margin;
    for (Projected& facet : facets) {
        for (auto& c : facet.corners) {
            c = {k_margin + scale * (c.x - low.x), k_margin + scale * (high.y - c.y)};
        }
    }
    const char* name = side == ViewSide::crown ? "crown view" : "pavilion view";
    std::string svg = fmt::format(
        "<svg class=\"stone\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"group\" aria-label=\"{}\">",
        width, height, name);
    std::string names;
    for (const Projected& projected : facets) {
        const auto f = static_cast<std::size_t>(projected.facet);
        const Facet& facet = solid.facets[f];
        const FacetPaint own = f < paint.size() ? paint[f] : FacetPaint{};
        const std::string about = own.about.empty() ? facet.name : facet.name + ": " + own.about;
        std::string points;
        for (const auto& c : projected.corners) points += fmt::format("{:.1f},{:.1f} ", c.x, c.y);
        points.pop_back();
        svg += fmt::format(
            "<g class=\"facet\" tabindex=\"0\" role=\"img\" aria-label=\"{0}\"><title>{0}</title>"
            "<polygon points=\"{1}\" style=\"fill:{2}\"/></g>",
            escaped(about), points, escaped(own.colour));
        const glm::dvec2 middle = middle_of(projected.corners);
        const double half_width = 0.3 * k_letter * static_cast<double>(facet.name.size());
        if (room_around(projected.corners, middle) > std::max(0.6 * k_letter, 0.8 * half_width)) {
            names += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", middle.x,
                                 middle.y + 0.35 * k_letter, escaped(facet.name));
        }
    }
    return svg + "<g class=\"names\" aria-hidden=\"true\">" + names + "</g></svg>";
}

}  // namespace culet
