#include "refine/spin/crown.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "stone/numbers/units.h"

namespace culet {

namespace {

constexpr double k_one_side = radians(10.0);
constexpr std::size_t k_most_sides = 16;
// From an edge of the table to its plane: sigmas, and parts of the width, since edges of a stone
// that does not stand level are found somewhat off.
constexpr double k_level = 4, k_flat = 0.006;
const double k_level_normal = std::cos(radians(6.0));
constexpr std::size_t k_least_sides = 4;
constexpr double k_strong_edge = 3.2;     // robust standard deviations
constexpr double k_apart = 0.012;         // of the width: from one edge to the next
constexpr std::size_t k_most_edges = 10;  // of a side

double apart(double a, double b) {
    return std::abs(std::remainder(a - b, 2 * std::numbers::pi));
}

bool surround(const std::vector<SurfaceEdge>& edges) {
    std::vector<double> azimuths;
    for (const SurfaceEdge& e : edges)
        azimuths.push_back(e.azimuth -
                           2 * std::numbers::pi * std::floor(e.azimuth / (2 * std::numbers::pi)));
    std::sort(azimuths.begin(), azimuths.end());
    double widest = azimuths.front() + 2 * std::numbers::pi - azimuths.back();
    for (std::size_t i = 1; i < azimuths.size(); ++i)
        widest = std::max(widest, azimuths[i] - azimuths[i - 1]);
    return widest < radians(200.0);
}

// z = c + a x + b y through the edges' middles.
Plane plane_through(const std::vector<SurfaceEdge>& edges) {
    Eigen::MatrixXd rows(Eigen::Index(edges.size()), 3);
    Eigen::VectorXd heights(Eigen::Index(edges.size()));
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const SurfaceEdge& e = edges[i];
        rows.row(Eigen::Index(i)) << 1, e.radius * std::cos(e.azimuth),
            e.radius * std::sin(e.azimuth);
        heights(Eigen::Index(i)) = e.height;
    }
    const Eigen::Vector3d c = rows.colPivHouseholderQr().solve(heights);
    const Vec3 normal = glm::normalize(Vec3(-c(1), -c(2), 1));
    return {normal, c(0) * normal.z};
}

double height_of(const Plane& plane, const SurfaceEdge& e) {
    return (plane.offset - e.radius * (plane.normal.x * std::cos(e.azimuth) +
                                       plane.normal.y * std::sin(e.azimuth))) /
           plane.normal.z;
}

struct Table {
    double strength = 0;
    std::vector<SurfaceEdge> edges;
};

// The strongest edge of each side in the plane. Nothing of a stone lies above its table: the
// strongest edge there counts against it.
Table table_in(const Plane& plane, const std::vector<std::vector<SurfaceEdge>>& sides,
               double within) {
    Table table;
    for (const auto& side : sides) {
        double on = 0, above = 0;
        for (const SurfaceEdge& e : side) {
            if (e.strength < k_strong_edge) break;
            const double over = e.height - height_of(plane, e);
            if (over > within) above = std::max(above, e.strength);
            if (std::abs(over) > within || on > 0) continue;
            on = e.strength;
            table.edges.push_back(e);
        }
        table.strength += on - above;
    }
    return table;
}

// The strongest of all nearly level planes through three edges in which enough sides have one.
Table strongest_table(const std::vector<std::vector<SurfaceEdge>>& sides, double within) {
    std::vector<SurfaceEdge> all;
    for (const auto& side : sides) {
        for (std::size_t i = 0; i < std::min(side.size(), k_most_edges); ++i) {
            if (side[i].strength >= k_strong_edge) all.push_back(side[i]);
        }
    }
    Table best;
    const auto is_other_side = [&](std::size_t a, std::size_t b) {
        return apart(all[a].azimuth, all[b].azimuth) > 2 * k_one_side;
    };
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t j = i + 1; j < all.size(); ++j) {
            if (!is_other_side(i, j)) continue;
            for (std::size_t k = j + 1; k < all.size(); ++k) {
                if (!is_other_side(i, k) || !is_other_side(j, k)) continue;
                const Plane plane = plane_through({all[i], all[j], all[k]});
                if (!(plane.normal.z > k_level_normal)) continue;
                Table table = table_in(plane, sides, within);
                if (table.strength > best.strength && table.edges.size() >= k_least_sides &&
                    surround(table.edges))
                    best = std::move(table);
            }
        }
    }
    return best;
}

// From the table's edge outwards and down, each facet steeper than the one before: of all such
// chains that of the greatest strength.
std::vector<SurfaceEdge> chain_from(const SurfaceEdge& table, const std::vector<SurfaceEdge>& side,
                                    double least) {
    std::vector<SurfaceEdge> below;
    for (const SurfaceEdge& e : side) {
        if (e.radius > table.radius + least && e.height < table.height - least / 2)
            below.push_back(e);
    }
    if (below.size() > k_most_edges) below.resize(k_most_edges);
    std::sort(below.begin(), below.end(),
              [](const SurfaceEdge& a, const SurfaceEdge& b) { return a.radius < b.radius; });
    std::vector<SurfaceEdge> best{table};
    double most = 0;
    for (unsigned choice = 1; choice < 1u << below.size(); ++choice) {
        std::vector<SurfaceEdge> chain{table};
        double strength = 0, slope = 0;
        bool is_convex = true;
        for (std::size_t i = 0; i < below.size() && is_convex; ++i) {
            if (!(choice >> i & 1)) continue;
            const double out = below[i].radius - chain.back().radius,
                         down = chain.back().height - below[i].height;
            is_convex = out > least / 2 && down > least / 2 && down / out > 1.1 * slope;
            slope = down / out;
            // A facet more must be worth more than noise.
            strength += below[i].strength - k_strong_edge;
            chain.push_back(below[i]);
        }
        if (!is_convex || !(strength > most)) continue;
        most = strength;
        best = chain;
    }
    return best;
}

}  // namespace

std::vector<SweptSide> sides_of(const Solid& upright, const std::vector<bool>& seen) {
    std::vector<std::size_t> order;
    std::vector<double> areas;
    double top = -HUGE_VAL, width = HUGE_VAL;
    for (std::size_t f = 0; f < upright.facets.size(); ++f) {
        areas.push_back(area(upright, upright.facets[f]));
        const Vec3& n = upright.facets[f].plane.normal;
        if (seen[f] && std::hypot(n.x, n.y) > 0.5) order.push_back(f);
    }
    for (const Vec3& v : upright.vertices) top = std::max(top, v.z);
    width = width_along(upright, {1, 0, 0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
    std::vector<SweptSide> sides;
    for (const std::size_t f : order) {
        const Vec3& n = upright.facets[f].plane.normal;
        const double azimuth = std::atan2(n.y, n.x);
        const bool is_known = std::any_of(sides.begin(), sides.end(), [&](const SweptSide& s) {
            return apart(s.azimuth, azimuth) < k_one_side;
        });
        if (is_known || sides.size() >= k_most_sides) continue;
        SweptSide side;
        side.azimuth = azimuth;
        const Vec3 out{std::cos(azimuth), std::sin(azimuth), 0}, along{-out.y, out.x, 0};
        double least = HUGE_VAL, most = -HUGE_VAL;
        for (const int c : upright.facets[f].corners) {
            least = std::min(least, glm::dot(along, upright.vertices[std::size_t(c)]));
            most = std::max(most, glm::dot(along, upright.vertices[std::size_t(c)]));
        }
        double reach = 0;
        for (const Vec3& v : upright.vertices) reach = std::max(reach, glm::dot(out, v));
        side.middle = (least + most) / 2;
        side.half_length = std::clamp(0.3 * (most - least), 0.03 * width, 0.09 * width);
        side.least_radius = 0.15 * width;
        side.most_radius = reach + 0.03 * width;
        side.least_height = top - 0.4 * width;
        side.most_height = top + 0.08 * width;
        sides.push_back(side);
    }
    return sides;
}

std::optional<Crown> crown_of(const std::vector<std::vector<SurfaceEdge>>& edges, double width,
                              double edge_sigma) {
    const Table table = strongest_table(edges, std::max(k_level * edge_sigma, k_flat * width));
    if (table.edges.empty()) return std::nullopt;
    Crown crown;
    crown.table.edges = table.edges;
    double radii = 0;
    for (const SurfaceEdge& e : crown.table.edges) radii += e.radius;
    const double count = double(crown.table.edges.size());
    crown.table.plane = plane_through(crown.table.edges);
    crown.table.tilt_sigma = edge_sigma / (radii / count) / std::sqrt(count / 2);
    for (const SurfaceEdge& e : crown.table.edges) {
        for (const auto& side : edges) {
            if (side.empty() || side[0].azimuth != e.azimuth) continue;
            const std::vector<SurfaceEdge> chain = chain_from(e, side, k_apart * width);
            if (chain.size() > 1) crown.outermost.push_back(chain.back());
            for (std::size_t i = 1; i < chain.size(); ++i) {
                const double out = chain[i].radius - chain[i - 1].radius,
                             down = chain[i - 1].height - chain[i].height,
                             length = std::hypot(out, down);
                const Vec3 normal{down / length * std::cos(e.azimuth),
                                  down / length * std::sin(e.azimuth), out / length};
                const double offset =
                    down / length * chain[i].radius + out / length * chain[i].height;
                crown.facets.push_back({{normal, offset},
                                        std::sqrt(2.0) * edge_sigma / length,
                                        {chain[i - 1], chain[i]}});
            }
        }
    }
    return crown;
}

}  // namespace culet
