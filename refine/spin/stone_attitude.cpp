#include "refine/spin/stone_attitude.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "stone/numbers/units.h"
#include "stone/solid/caliper.h"
#include "stone/solid/perpendicular.h"

namespace culet {

namespace {

constexpr double k_step = radians(3.0), k_last_step = radians(0.01);

// Of the outline, twice: each facet's area as seen along the direction, from both sides.
double doubled_outline(const Solid& solid, const std::vector<double>& areas, const Vec3& along) {
    double sum = 0;
    for (std::size_t f = 0; f < areas.size(); ++f)
        sum += areas[f] * std::abs(glm::dot(solid.facets[f].plane.normal, along));
    return sum;
}

// `look` makes a direction the best if it is better, and tells.
template <class Look>
void climb(const Vec3& best, double step, const Look& look) {
    while (step > k_last_step) {
        const Vec3 at = best, t = perpendicular_to(at), u = glm::cross(at, t);
        bool moved = false;
        for (const Vec3& side : {t, -t, u, -u}) moved |= look(glm::normalize(at + step * side));
        if (!moved) step /= 2;
    }
}

Vec3 widest_along(const Solid& solid) {
    std::vector<double> areas;
    for (const Facet& facet : solid.facets) areas.push_back(area(solid, facet));
    Vec3 best{0, 0, 1};
    double most = doubled_outline(solid, areas, best);
    const auto look = [&](const Vec3& direction) {
        const double seen = doubled_outline(solid, areas, direction);
        if (!(seen > most)) return false;
        most = seen;
        best = direction;
        return true;
    };
    for (double polar = k_step; polar < std::numbers::pi / 2; polar += k_step) {
        const double around = k_step / std::sin(polar);
        for (double azimuth = 0; azimuth < 2 * std::numbers::pi; azimuth += around)
            look({std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                  std::cos(polar)});
    }
    climb(best, k_step / 2, look);
    return best;
}

// A facet's partner is so far off (one sigma), while the axis is looked for and then; the axis so
// far from where the stone is widest.
constexpr double k_roughly_alike = radians(3.0), k_alike_normals = radians(1.5),
                 k_furthest = radians(25.0);
constexpr double k_least_share = 0.3;
const double k_most_upright = std::cos(radians(20.0));

// Part of the seen facets' area that half a turn about the axis brings onto other seen facets.
double half_turn_share(const Solid& solid, const std::vector<double>& areas, const Vec3& axis,
                       double alike_sigma) {
    double alike = 0, all = 0;
    for (std::size_t f = 0; f < areas.size(); ++f) {
        const Vec3& n = solid.facets[f].plane.normal;
        // A facet across the axis is its own partner, and says nothing.
        if (!(areas[f] > 0) || std::abs(glm::dot(n, axis)) > k_most_upright) continue;
        const Vec3 turned = 2 * glm::dot(n, axis) * axis - n;
        double nearest = std::numbers::pi;
        for (std::size_t g = 0; g < areas.size(); ++g) {
            if (areas[g] > 0)
                nearest = std::min(nearest, angle_between(turned, solid.facets[g].plane.normal));
        }
        alike += areas[f] * std::exp(-0.5 * std::pow(nearest / alike_sigma, 2));
        all += areas[f];
    }
    return all > 0 ? alike / all : 0;
}

// Most cuts look the same after half a turn. `about` if this stone does not.
Vec3 axis_of_half_turn(const Solid& solid, const std::vector<bool>& seen, const Vec3& about) {
    std::vector<double> areas;
    for (std::size_t f = 0; f < seen.size(); ++f)
        areas.push_back(seen[f] ? area(solid, solid.facets[f]) : 0);
    const Vec3 t = perpendicular_to(about), u = glm::cross(about, t);
    Vec3 best = about;
    double most = k_least_share, alike = k_roughly_alike;
    const auto look = [&](const Vec3& axis) {
        const double share = half_turn_share(solid, areas, axis, alike);
        if (!(share > most)) return false;
        most = share;
        best = axis;
        return true;
    };
    const int steps = int(k_furthest / k_alike_normals);
    for (int i = -steps; i <= steps; ++i) {
        for (int k = -steps; k <= steps; ++k)
            look(glm::normalize(about + std::tan(i * k_alike_normals) * t +
                                std::tan(k * k_alike_normals) * u));
    }
    if (most == k_least_share) return about;
    alike = k_alike_normals;
    most = half_turn_share(solid, areas, best, alike);
    climb(best, k_alike_normals / 2, look);
    return best;
}

Vec3 in_axes(const StoneAttitude& at, const Vec3& v) {
    return {glm::dot(at.x, v), glm::dot(at.y, v), glm::dot(at.z, v)};
}

}  // namespace

StoneAttitude attitude_about(const Solid& solid, const Vec3& up) {
    const double azimuth = caliper_widths(solid, up).least_azimuth;
    const PlanFrame plan = plan_frame(up);
    const Vec3 x = std::cos(azimuth) * plan.x + std::sin(azimuth) * plan.y;
    return {x, glm::cross(up, x), up};
}

StoneAttitude attitude_of(const Solid& solid, const std::vector<bool>& seen, const Vec3& up) {
    const Vec3 axis = axis_of_half_turn(solid, seen, widest_along(solid));
    return attitude_about(solid, glm::dot(axis, up) < 0 ? -axis : axis);
}

bool ends_are_seen(const Solid& solid, const std::vector<bool>& seen, const Vec3& along) {
    for (const Vec3& way : {along, -along}) {
        const std::vector<Vec3>& all = solid.vertices;
        const auto end = std::max_element(
            all.begin(), all.end(),
            [&](const Vec3& a, const Vec3& b) { return glm::dot(a, way) < glm::dot(b, way); });
        std::size_t bounding = 0;
        double most = -1;
        for (std::size_t f = 0; f < solid.facets.size(); ++f) {
            const std::vector<int>& corners = solid.facets[f].corners;
            const double facing = glm::dot(solid.facets[f].plane.normal, way);
            if (std::count(corners.begin(), corners.end(), int(end - all.begin())) == 0 ||
                facing <= most)
                continue;
            most = facing;
            bounding = f;
        }
        if (!seen[bounding]) return false;
    }
    return true;
}

Solid upright(Solid solid, const StoneAttitude& attitude) {
    for (Vec3& v : solid.vertices) v = in_axes(attitude, v);
    for (Facet& f : solid.facets) f.plane.normal = in_axes(attitude, f.plane.normal);
    return solid;
}

Projection projection_of(const PictureAxes& axes, const StoneAttitude& attitude,
                         const LevelPicture& picture) {
    const Vec3 across = in_axes(attitude, axes.across), along = in_axes(attitude, axes.along),
               near = in_axes(attitude, axes.nearing);
    const double u = picture.width / 2.0 + axes.dx, v = picture.height / 2.0 - axes.dy;
    Projection p{};
    for (int i = 0; i < 3; ++i) {
        const auto k = std::size_t(i);
        p[0][k] = across[i] - u * near[i];
        p[1][k] = -along[i] - v * near[i];
        p[2][k] = -near[i];
    }
    p[0][3] = u;
    p[1][3] = v;
    p[2][3] = 1;
    return p;
}

}  // namespace culet
