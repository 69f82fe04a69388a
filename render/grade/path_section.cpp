#include "render/grade/path_section.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>
#include <optional>

#include "render/optics/fresnel.h"
#include "stone/design/tiers.h"
#include "stone/numbers/units.h"
#include "stone/stone.h"

namespace culet {

namespace {

using Point = glm::dvec2;

constexpr int k_paths = 13, k_most_faces = 9;
constexpr double k_least_side = 1e-6;  // length of a normal's part in the section
constexpr double k_outside = 0.35;     // drawn length of rays outside the stone, relative to its
                                       // width
constexpr double k_nudge = 1e-9;       // relative to the width: a path does not hit the side where
                                       // it starts
constexpr double k_exits = 0.5;

struct Side {
    Point normal{0, 0};
    double offset = 0;
};

struct Polygon {
    std::vector<Point> corners;  // counter-clockwise
    std::vector<Side> sides;
};

// Clips a large square (Sutherland and Hodgman 1974).
Polygon section_of(const Solid& solid, const Vec3& along, const Vec3& middle, double size) {
    Polygon polygon;
    polygon.corners = {{-size, -size}, {size, -size}, {size, size}, {-size, size}};
    for (const Facet& facet : solid.facets) {
        const Point normal{glm::dot(facet.plane.normal, along), facet.plane.normal.z};
        const double length = glm::length(normal);
        if (length < k_least_side) continue;
        const Side side{normal / length,
                        (facet.plane.offset - glm::dot(facet.plane.normal, middle)) / length};
        polygon.sides.push_back(side);
        std::vector<Point> kept;
        for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
            const Point &p = polygon.corners[i],
                        &q = polygon.corners[(i + 1) % polygon.corners.size()];
            const double a = glm::dot(side.normal, p) - side.offset,
                         b = glm::dot(side.normal, q) - side.offset;
            if (a <= 0) kept.push_back(p);
            if ((a < 0 && b > 0) || (a > 0 && b < 0)) kept.push_back(p + a / (a - b) * (q - p));
        }
        polygon.corners = std::move(kept);
    }
    return polygon;
}

struct Hit {
    double distance = 0;
    Point normal{0, 0};
};

// Where a path inside the stone exits.
std::optional<Hit> exit_of(const Polygon& polygon, const Point& from, const Point& d,
                           double least) {
    std::optional<Hit> nearest;
    for (const Side& side : polygon.sides) {
        const double towards = glm::dot(side.normal, d);
        if (!(towards > 0)) continue;
        const double distance = (side.offset - glm::dot(side.normal, from)) / towards;
        if (distance < least || (nearest && distance >= nearest->distance)) continue;
        nearest = Hit{distance, side.normal};
    }
    return nearest;
}

// Where a path from above hits the stone: the last of the sides that it enters.
std::optional<Hit> entry_of(const Polygon& polygon, const Point& from, const Point& d) {
    double enters = 0, exits = std::numeric_limits<double>::infinity();
    std::optional<Hit> last;
    for (const Side& side : polygon.sides) {
        const double towards = glm::dot(side.normal, d);
        const double height = side.offset - glm::dot(side.normal, from);
        if (std::abs(towards) < k_least_side) {
            if (height < 0) return std::nullopt;
            continue;
        }
        const double distance = height / towards;
        if (towards > 0) {
            exits = std::min(exits, distance);
        } else if (distance > enters) {
            enters = distance;
            last = Hit{distance, side.normal};
        }
    }
    if (!last || !(enters < exits)) return std::nullopt;
    return last;
}

// `normal` points against the light; `n2`: index beyond the face.
Point refracted(const Point& d, const Point& normal, double n1, double n2) {
    const double cosine = -glm::dot(normal, d);
    const FaceReflection face = mean_reflection(n1, n2, n1 * std::clamp(cosine, 0.0, 1.0));
    return glm::normalize(n1 * d + (n1 * cosine - face.q2) * normal);
}

SectionEnd end_of(const Point& d, double head) {
    if (!(d.y > 0)) return SectionEnd::leak;
    return d.y > std::cos(head) ? SectionEnd::head : SectionEnd::returned;
}

SectionPoint written(const Point& p) {
    return {p.x, p.y};
}

std::optional<SectionPath> path_from(const Polygon& polygon, double n, double head, double x,
                                     double top, double width) {
    const Point start{x, top + k_outside * width};
    Point d{0, -1};
    const std::optional<Hit> entry = entry_of(polygon, start, d);
    if (!entry) return std::nullopt;
    SectionPath path;
    Point at = start + entry->distance * d;
    path.points = {written(start), written(at)};
    d = refracted(d, entry->normal, 1, n);
    for (int face = 1; face < k_most_faces; ++face) {
        const std::optional<Hit> hit = exit_of(polygon, at, d, k_nudge * width);
        if (!hit) return path;
        at += hit->distance * d;
        path.points.push_back(written(at));
        const double cosine = std::clamp(glm::dot(hit->normal, d), 0.0, 1.0);
        const FaceReflection met = mean_reflection(n, 1, n * cosine);
        if (!met.total && 1 - met.mean > k_exits) {
            d = refracted(d, -hit->normal, n, 1);
            path.points.push_back(written(at + k_outside * width * d));
            path.end = end_of(d, head);
            return path;
        }
        d -= 2 * glm::dot(hit->normal, d) * hit->normal;
    }
    return path;
}

double section_azimuth(const Solid& solid) {
    const std::vector<int> mains = main_facets(solid, {0, 0, 1}, false);
    if (mains.empty()) return 0;
    const Vec3& normal = solid.facets[static_cast<std::size_t>(mains.front())].plane.normal;
    return std::hypot(normal.x, normal.y) > k_least_side ? azimuth(normal) : 0;
}

}  // namespace

const char* name_of(SectionEnd end) {
    switch (end) {
        case SectionEnd::returned:
            return "returned";
        case SectionEnd::head:
            return "head";
        case SectionEnd::leak:
            return "leak";
        case SectionEnd::trapped:
            return "trapped";
    }
    return "";
}

PathSection path_section(const Solid& convex, double n, double head) {
    PathSection section;
    section.azimuth = section_azimuth(convex);
    const Vec3 along{std::cos(section.azimuth), std::sin(section.azimuth), 0};
    const Polygon polygon = section_of(convex, along, centroid(convex), 2 * diameter(convex));
    if (polygon.corners.size() < 3) return section;
    double left = polygon.corners.front().x, right = left, top = polygon.corners.front().y;
    for (const Point& corner : polygon.corners) {
        section.outline.push_back(written(corner));
        left = std::min(left, corner.x);
        right = std::max(right, corner.x);
        top = std::max(top, corner.y);
    }
    const double width = right - left;
    for (int i = 0; i < k_paths; ++i) {
        const double x = left + width * (i + 0.5) / k_paths;
        if (auto path = path_from(polygon, n, head, x, top, width))
            section.paths.push_back(std::move(*path));
    }
    return section;
}

std::string section_json(const PathSection& section) {
    using Json = nlohmann::ordered_json;
    Json paths = Json::array();
    for (const SectionPath& path : section.paths)
        paths.push_back({{"points", path.points}, {"end", name_of(path.end)}});
    const Json json{
        {"azimuth_deg", degrees(section.azimuth)}, {"outline", section.outline}, {"paths", paths}};
    return json.dump();
}

}  // namespace culet
