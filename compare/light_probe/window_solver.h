#pragma once
// Solves for one rectangle from one start (window_fit.h).

#include <ceres/rotation.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "compare/light_probe/window_fit.h"
#include "stone/solid/perpendicular.h"

namespace culet::window {

/// The window in units of its distance: the middle's two offsets from the start direction, and the
/// nearness; a rotation (about the two axes across that direction, then about itself); the
/// logarithms of the half-extents.
enum Parameter { beside_x, beside_y, near, tilt_x, tilt_y, roll, log_u, log_v, parameter_count };
using Parameters = std::array<double, parameter_count>;

/// Axes at the start direction.
struct Frame {
    Vec3 towards, across, along;
    explicit Frame(const Vec3& direction)
        : towards(direction),
          across(perpendicular_to(direction)),
          along(glm::cross(direction, across)) {}
};

template <class Number>
using Vector = std::array<Number, 3>;

/// Middle and half-extents, times the nearness.
template <class Number>
struct ScaledWindow {
    Vector<Number> middle, u, v;
};

template <class Number>
ScaledWindow<Number> window_of(const Frame& frame, const Number* p) {
    using std::exp;
    const auto in_world = [&](const Number& x, const Number& y, const Number& z) {
        Vector<Number> w;
        for (int k = 0; k < 3; ++k)
            w[static_cast<std::size_t>(k)] =
                x * frame.across[k] + y * frame.along[k] + z * frame.towards[k];
        return w;
    };
    // Roll about the line of sight first, then tilt.
    const Number rolled[3] = {Number(0), Number(0), p[roll]};
    const Number tilted[3] = {p[tilt_x], p[tilt_y], Number(0)};
    const auto turned = [&](int axis, const Number& length) {
        Number start[3] = {Number(0), Number(0), Number(0)}, middle[3], end[3];
        start[axis] = length;
        ceres::AngleAxisRotatePoint(rolled, start, middle);
        ceres::AngleAxisRotatePoint(tilted, middle, end);
        return in_world(end[0], end[1], end[2]);
    };
    return {in_world(p[beside_x], p[beside_y], Number(1)), turned(0, exp(p[log_u])),
            turned(1, exp(p[log_v]))};
}

/// Sine of the angle by which a direction passes inside the nearest of the four planes through the
/// place and an edge; negative outside. `place`: times the nearness.
template <class Number>
Number inside_edges(const ScaledWindow<Number>& w, const Vector<Number>& place,
                    const Vector<Number>& direction) {
    using std::sqrt;
    Vector<Number> middle;
    for (std::size_t k = 0; k < 3; ++k) middle[k] = w.middle[k] - place[k];
    Number least(2);
    for (int side = 0; side < 4; ++side) {
        const Vector<Number>& out = side < 2 ? w.u : w.v;
        const Vector<Number>& edge = side < 2 ? w.v : w.u;
        const double sign = side % 2 == 0 ? 1 : -1;
        Vector<Number> on_edge;
        for (std::size_t k = 0; k < 3; ++k) on_edge[k] = middle[k] + sign * out[k];
        Vector<Number> normal;
        ceres::CrossProduct(on_edge.data(), edge.data(), normal.data());
        const auto along = [&](const Vector<Number>& v) {
            return ceres::DotProduct(normal.data(), v.data());
        };
        Number inside = along(direction) / sqrt(along(normal));
        if (along(middle) < 0.0) inside = -inside;
        if (inside < least) least = inside;
    }
    return least;
}

struct Solved {
    Parameters at{};
    double cost = std::numeric_limits<double>::infinity();
    double nearness_sigma = 0, tilt_sigma = 0;
    double residual = 0;
};

/// Infinitely dear where it fails.
Solved solved(const Frame& frame, const std::vector<SeenOutline>& outlines, const Parameters& start,
              bool hold_nearness, bool facing);

}  // namespace culet::window
