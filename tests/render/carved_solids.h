#pragma once
// Closed non-convex solids, most with small integer coordinates, and simple tests of where a point
// is.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "stone/cuts/cuts.h"
#include "stone/solid/solid.h"
#include "tests/render/random_direction.h"

namespace culet::carved {

using Loops = std::vector<std::vector<int>>;

inline Solid solid_of(std::vector<Vec3> vertices, const Loops& loops) {
    Solid solid;
    solid.vertices = std::move(vertices);
    for (const std::vector<int>& loop : loops) {
        std::vector<Vec3> points;
        for (const int v : loop) points.push_back(solid.vertices[static_cast<std::size_t>(v)]);
        solid.facets.push_back(
            {"f" + std::to_string(solid.facets.size()), plane_through(points), loop});
    }
    return solid;
}

// Facet 0 is the top, facet 1 the bottom, then one side from each corner to the next.
inline Solid prism(const std::vector<std::pair<double, double>>& outline, double low, double high) {
    const int n = static_cast<int>(outline.size());
    std::vector<Vec3> vertices;
    for (const auto& [x, y] : outline) vertices.push_back({x, y, low});
    for (const auto& [x, y] : outline) vertices.push_back({x, y, high});
    Loops loops(2);
    for (int i = 0; i < n; ++i) {
        loops[0].push_back(n + i);
        loops[1].push_back(n - 1 - i);
    }
    for (int i = 0; i < n; ++i) {
        const int j = (i + 1) % n;
        loops.push_back({i, j, n + j, n + i});
    }
    return solid_of(std::move(vertices), loops);
}

inline Solid l_prism() {
    return prism({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}}, 0, 1);
}

// Two arms with a gap between: x from 0 to 1 and from 2 to 3, joined at the bottom.
inline Solid u_prism() {
    return prism({{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}, 0, 1);
}

inline Solid star_prism() {
    return prism({{4, 0}, {1, 1}, {0, 4}, {-1, 1}, {-4, 0}, {-1, -1}, {0, -4}, {1, -1}}, -1, 2);
}

// A box with a pyramid carved into its top. The top facet has a hole, joined to its outline by an
// edge that the outline traverses twice. Facet 0 is the top, facets 6 to 9 the notch.
inline Solid notched_box() {
    return solid_of({{-2, -2, -2},
                     {2, -2, -2},
                     {2, 2, -2},
                     {-2, 2, -2},
                     {-2, -2, 2},
                     {2, -2, 2},
                     {2, 2, 2},
                     {-2, 2, 2},
                     {-1, -1, 2},
                     {1, -1, 2},
                     {1, 1, 2},
                     {-1, 1, 2},
                     {0, 0, -1}},
                    {{4, 5, 6, 7, 4, 8, 11, 10, 9, 8},
                     {3, 2, 1, 0},
                     {0, 1, 5, 4},
                     {1, 2, 6, 5},
                     {2, 3, 7, 6},
                     {3, 0, 4, 7},
                     {8, 9, 12},
                     {9, 10, 12},
                     {10, 11, 12},
                     {11, 8, 12}});
}

// A square ring (genus 1): x and y from -3 to 3 with a hole from -1 to 1, z from 0 to 1.
inline Solid ring() {
    return solid_of({{-3, -3, 0},
                     {3, -3, 0},
                     {3, 3, 0},
                     {-3, 3, 0},
                     {-1, -1, 0},
                     {1, -1, 0},
                     {1, 1, 0},
                     {-1, 1, 0},
                     {-3, -3, 1},
                     {3, -3, 1},
                     {3, 3, 1},
                     {-3, 3, 1},
                     {-1, -1, 1},
                     {1, -1, 1},
                     {1, 1, 1},
                     {-1, 1, 1}},
                    {{8, 9, 10, 11, 8, 12, 15, 14, 13, 12},
                     {0, 4, 5, 6, 7, 4, 0, 3, 2, 1},
                     {0, 1, 9, 8},
                     {1, 2, 10, 9},
                     {2, 3, 11, 10},
                     {3, 0, 8, 11},
                     {5, 4, 12, 13},
                     {6, 5, 13, 14},
                     {7, 6, 14, 15},
                     {4, 7, 15, 12}});
}

// Two unit cubes with one common edge, which four facets share.
inline Solid cubes_on_one_edge() {
    return solid_of({{0, 0, 0},
                     {0, 0, 1},
                     {1, 0, 0},
                     {1, 1, 0},
                     {0, 1, 0},
                     {1, 0, 1},
                     {1, 1, 1},
                     {0, 1, 1},
                     {-1, 0, 0},
                     {-1, -1, 0},
                     {0, -1, 0},
                     {-1, 0, 1},
                     {-1, -1, 1},
                     {0, -1, 1}},
                    {{1, 5, 6, 7},
                     {0, 4, 3, 2},
                     {0, 2, 5, 1},
                     {2, 3, 6, 5},
                     {3, 4, 7, 6},
                     {4, 0, 1, 7},
                     {1, 11, 12, 13},
                     {0, 10, 9, 8},
                     {0, 8, 11, 1},
                     {8, 9, 12, 11},
                     {9, 10, 13, 12},
                     {10, 0, 1, 13}});
}

// Triangles round the origin at random integer distances of 20 to 100.
inline Solid crag(unsigned seed, int meridians = 9, int parallels = 6) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> radius(20, 100);
    const auto at = [&](double colatitude, double azimuth) {
        const double r = radius(random);
        return Vec3{std::round(r * std::sin(colatitude) * std::cos(azimuth)),
                    std::round(r * std::sin(colatitude) * std::sin(azimuth)),
                    std::round(r * std::cos(colatitude))};
    };
    std::vector<Vec3> vertices{at(0, 0), at(std::acos(-1), 0)};
    for (int p = 1; p < parallels; ++p) {
        for (int m = 0; m < meridians; ++m) {
            vertices.push_back(at(std::acos(-1) * p / parallels,
                                  2 * std::acos(-1) * (m + 0.5 * (p % 2)) / meridians));
        }
    }
    const auto id = [&](int p, int m) { return 2 + (p - 1) * meridians + m % meridians; };
    Loops loops;
    for (int m = 0; m < meridians; ++m) {
        loops.push_back({0, id(1, m), id(1, m + 1)});
        loops.push_back({1, id(parallels - 1, m + 1), id(parallels - 1, m)});
        for (int p = 1; p + 1 < parallels; ++p) {
            loops.push_back({id(p, m), id(p + 1, m), id(p + 1, m + 1)});
            loops.push_back({id(p, m), id(p + 1, m + 1), id(p, m + 1)});
        }
    }
    return solid_of(std::move(vertices), loops);
}

// Applies x -> scale * turn * x + shift to corners and planes.
inline Solid moved(const Solid& solid, const glm::dmat3& turn, double scale, const Vec3& shift) {
    Solid result = solid;
    for (Vec3& vertex : result.vertices) vertex = scale * (turn * vertex) + shift;
    for (Facet& facet : result.facets) {
        facet.plane.normal = turn * facet.plane.normal;
        facet.plane.offset = scale * facet.plane.offset + glm::dot(facet.plane.normal, shift);
    }
    return result;
}

inline glm::dmat3 random_turn(std::mt19937_64& random) {
    const Vec3 x = random_direction(random);
    const Vec3 z = glm::normalize(glm::cross(x, random_direction(random)));
    return {x, glm::cross(z, x), z};
}

struct NamedSolid {
    std::string name;
    Solid solid;
};

inline std::vector<NamedSolid> all() {
    return {{"L prism", l_prism()},
            {"U prism", u_prism()},
            {"star prism", star_prism()},
            {"notched box", notched_box()},
            {"ring", ring()},
            {"cubes on one edge", cubes_on_one_edge()},
            {"crag", crag(7)},
            {"heart", make_cut("heart")}};
}

struct Ray {
    Vec3 origin, direction;
};

inline Vec3 middle_of(const Solid& solid) {
    Vec3 low = solid.vertices[0], high = low;
    for (const Vec3& v : solid.vertices) {
        low = glm::min(low, v);
        high = glm::max(high, v);
    }
    return 0.5 * (low + high);
}

inline Ray random_ray(const Solid& solid, std::mt19937_64& random) {
    std::uniform_real_distribution<double> uniform(-0.5, 0.5);
    const double size = diameter(solid);
    const Vec3 middle = middle_of(solid);
    const Vec3 to = middle + size * Vec3{uniform(random), uniform(random), uniform(random)};
    const Vec3 from = middle + 2 * size * random_direction(random);
    return {from, glm::normalize(to - from)};
}

// The solid angle of the stone's surface over 4 pi (van Oosterom & Strackee 1983): 1 inside.
inline double winding_of(const Solid& solid, const Vec3& point) {
    double sum = 0;
    for (const Facet& facet : solid.facets) {
        const auto arm = [&](std::size_t i) {
            return solid.vertices[static_cast<std::size_t>(facet.corners[i])] - point;
        };
        const Vec3 a = arm(0);
        for (std::size_t i = 1; i + 1 < facet.corners.size(); ++i) {
            const Vec3 b = arm(i), c = arm(i + 1);
            const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
            sum += 2 * std::atan2(glm::dot(a, glm::cross(b, c)),
                                  la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la +
                                      glm::dot(c, a) * lb);
        }
    }
    return sum / (4 * std::acos(-1));
}

inline double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 edge = b - a;
    const double part = std::clamp(glm::dot(p - a, edge) / glm::dot(edge, edge), 0.0, 1.0);
    return glm::length(p - a - part * edge);
}

// The distance of a point from a facet: 0 within its outline.
inline double distance_to_facet(const Solid& solid, int index, const Vec3& point) {
    const Facet& facet = solid.facets[static_cast<std::size_t>(index)];
    const double height = height_above(facet.plane, point);
    const Vec3 foot = point - height * facet.plane.normal;
    double angle = 0, nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < facet.corners.size(); ++i) {
        const auto at = [&](std::size_t k) {
            return solid
                .vertices[static_cast<std::size_t>(facet.corners[k % facet.corners.size()])];
        };
        const Vec3 a = at(i) - foot, b = at(i + 1) - foot;
        nearest = std::min(nearest, distance_to_segment(foot, at(i), at(i + 1)));
        angle += std::atan2(glm::dot(facet.plane.normal, glm::cross(a, b)), glm::dot(a, b));
    }
    return std::hypot(height, std::abs(angle) > std::acos(-1) ? 0 : nearest);
}

}  // namespace culet::carved
