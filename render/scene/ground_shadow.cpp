#include "render/scene/ground_shadow.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace culet {

namespace {

// Of the light that falls on a clear stone, what leaves it downwards, by eye.
constexpr double k_passed = 0.2;
// Pixels between computed points; the light in between is interpolated.
constexpr int k_step = 8;

// Part of a level place's irradiance that comes through a polygon above it (Lambert 1760; Arvo
// 1995, "Applications of irradiance tensors", eq. 3.6). The corners run counter-clockwise as seen
// from the place.
double part_through(const std::vector<int>& corners, const std::vector<Vec3>& directions) {
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 &a = directions[static_cast<std::size_t>(corners[i])],
                   &b = directions[static_cast<std::size_t>(corners[(i + 1) % corners.size()])];
        const Vec3 across = glm::cross(a, b);
        const double sine = glm::length(across);
        if (sine > 0) sum += std::atan2(sine, glm::dot(a, b)) / sine * across.z;
    }
    return std::abs(sum) / (2 * std::numbers::pi);
}

double lit_at(const Vec3& place, const Solid& solid, std::vector<Vec3>& directions) {
    for (std::size_t v = 0; v < directions.size(); ++v) {
        const Vec3 towards = solid.vertices[v] - place;
        const double distance = glm::length(towards);
        if (!(distance > 0)) return k_passed;
        directions[v] = towards / distance;
    }
    double hidden = 0;
    for (const Facet& facet : solid.facets) {
        if (glm::dot(facet.plane.normal, place) > facet.plane.offset)
            hidden += part_through(facet.corners, directions);
    }
    return 1 - (1 - k_passed) * std::min(hidden, 1.0);
}

}  // namespace

std::vector<float> ground_lit(const Solid& solid, const Camera& camera) {
    const int columns = (camera.width + k_step - 1) / k_step + 1,
              rows = (camera.height + k_step - 1) / k_step + 1;
    double ground = solid.vertices.empty() ? 0 : solid.vertices.front().z;
    for (const Vec3& v : solid.vertices) ground = std::min(ground, v.z);
    const EyeRays rays(camera);
    std::vector<Vec3> directions(solid.vertices.size());
    std::vector<double> coarse;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const EyeRay ray = rays.through(column * k_step, row * k_step);
            const double along = (ground - ray.origin.z) / ray.direction.z;
            const bool meets = along > 0 && std::isfinite(along);
            coarse.push_back(meets ? lit_at(ray.origin + along * ray.direction, solid, directions)
                                   : 1);
        }
    }
    std::vector<float> lit;
    for (int y = 0; y < camera.height; ++y) {
        for (int x = 0; x < camera.width; ++x) {
            const double u = (x + 0.5) / k_step, v = (y + 0.5) / k_step;
            const auto at = [&](int i, int j) {
                return coarse[static_cast<std::size_t>((static_cast<int>(v) + j) * columns +
                                                       static_cast<int>(u) + i)];
            };
            const double s = u - std::floor(u), t = v - std::floor(v);
            lit.push_back(static_cast<float>(
                std::lerp(std::lerp(at(0, 0), at(1, 0), s), std::lerp(at(0, 1), at(1, 1), s), t)));
        }
    }
    return lit;
}

}  // namespace culet
