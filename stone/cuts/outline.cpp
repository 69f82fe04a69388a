#include "stone/cuts/outline.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace culet {

namespace {

constexpr double k_pi = std::numbers::pi;

// Even points are mains, odd ones breaks. A main is parallel to the chord of its breaks, so on a
// convex outline both lie inside its line.
Outline outline_of(const std::vector<Vec2>& points) {
    Outline outline;
    const std::size_t count = points.size();
    for (std::size_t i = 0; i < count; i += 2) {
        outline.mains.push_back(points[i]);
        outline.breaks.push_back(points[i + 1]);
        outline.tangents.push_back(glm::normalize(points[i + 1] - points[(i + count - 1) % count]));
    }
    return outline;
}

// Mirrors points[1] .. points[last - 1]; points[0] and points[last] lie on the axis.
std::vector<Vec2> mirrored(std::vector<Vec2> upper) {
    for (std::size_t i = upper.size() - 2; i >= 1; --i) upper.push_back({upper[i].x, -upper[i].y});
    return upper;
}

// The arc from (tip, 0), t = 0, to (0, half), where it is level.
Vec2 tail_point(double tip, double half, double t) {
    const double radius = (tip * tip + half * half) / (2 * half);
    const double angle = (1 - t) * std::asin(tip / radius);
    return t >= 1   ? Vec2{0, half}
           : t <= 0 ? Vec2{tip, 0}
                    : Vec2{radius * std::sin(angle), half - radius + radius * std::cos(angle)};
}

}  // namespace

Outline ellipse_outline(double length, double width, int mains, int segments) {
    const auto at = [=](double t) {
        return Vec2{0.5 * length * std::cos(t), 0.5 * width * std::sin(t)};
    };
    std::vector<Vec2> points;
    std::vector<std::vector<Vec2>> arcs;
    for (int j = 0; j < 2 * mains; ++j) {
        points.push_back(at(k_pi * j / mains));
        arcs.emplace_back();
        for (int s = 1; s < segments; ++s) {
            arcs.back().push_back(at(k_pi * (j + static_cast<double>(s) / segments) / mains));
        }
    }
    Outline outline = outline_of(points);
    outline.arcs = std::move(arcs);
    return outline;
}

Outline marquise_outline(double length, double width) {
    std::vector<Vec2> quarter, upper;
    for (int j = 0; j <= 4; ++j) quarter.push_back(tail_point(length / 2, width / 2, j / 4.0));
    upper = quarter;
    for (int j = 3; j >= 0; --j) upper.push_back({-quarter[j].x, quarter[j].y});
    return outline_of(mirrored(upper));
}

Outline pear_outline(double length, double width) {
    const double half = width / 2;
    std::vector<Vec2> upper;
    for (int j = 0; j <= 4; ++j) upper.push_back(tail_point(length - half, half, j / 4.0));
    for (int j = 1; j <= 4; ++j) {
        const double t = k_pi / 2 + k_pi / 8 * j;
        upper.push_back(j == 4 ? Vec2{-half, 0} : Vec2{half * std::cos(t), half * std::sin(t)});
    }
    return outline_of(mirrored(upper));
}

Outline trillion_outline(double width, double bulge) {
    // The corners lie on a circle; the extent along y is the triangle's side.
    const double corner = width / std::sqrt(3.0);
    std::vector<Vec2> points;
    for (int side = 0; side < 3; ++side) {
        const double a = 2 * k_pi / 3 * side, b = a + 2 * k_pi / 3;
        const Vec2 from{corner * std::cos(a), corner * std::sin(a)},
            to{corner * std::cos(b), corner * std::sin(b)};
        const Vec2 middle = 0.5 * (from + to);
        const Vec2 out = glm::normalize(middle);
        const double half = 0.5 * glm::length(to - from), sagitta = bulge * 2 * half;
        const double radius = (half * half + sagitta * sagitta) / (2 * sagitta);
        const double opening = std::asin(half / radius);
        for (int j = 0; j < 4; ++j) {
            const double t = -1 + 0.5 * j;
            const Vec2 along = glm::normalize(to - from);
            points.push_back(j == 0
                                 ? from
                                 : middle + radius * std::sin(t * opening) * along +
                                       (sagitta - radius + radius * std::cos(t * opening)) * out);
        }
    }
    return outline_of(points);
}

Outline cushion_outline(double length, double width, double exponent) {
    const auto power = [exponent](double v) {
        return std::copysign(std::pow(std::abs(v), 2 / exponent), v);
    };
    std::vector<Vec2> points;
    for (int j = 0; j < 16; ++j) {
        // Sines of multiples of a quarter turn must be exactly zero.
        static const double sines[] = {0, std::sin(k_pi / 8), std::sqrt(0.5), std::cos(k_pi / 8),
                                       1};
        const auto sine = [](int k) {
            k = ((k % 16) + 16) % 16;
            const double s = sines[k % 8 <= 4 ? k % 8 : 8 - k % 8];
            return k < 8 ? s : -s;
        };
        points.push_back({0.5 * length * power(sine(j + 4)), 0.5 * width * power(sine(j))});
    }
    return outline_of(points);
}

Outline heart_outline(double length, double width) {
    const double half = width / 2;
    const double lobe = 0.55 * half,
                 off_axis = 0.45 * half;  // radius of a lobe, and distance of its centre from the
                                          // axis
    const double tip = length - lobe;
    std::vector<Vec2> upper;
    for (int j = 0; j <= 3; ++j) upper.push_back(tail_point(tip, half, j / 3.0));
    const double notch_x = -std::sqrt(lobe * lobe - off_axis * off_axis);
    const double notch_angle = 2 * k_pi + std::atan2(-off_axis, notch_x);
    for (int j = 1; j <= 3; ++j) {
        const double t = k_pi / 2 + (notch_angle - k_pi / 2) * j / 4;
        upper.push_back({lobe * std::cos(t), off_axis + lobe * std::sin(t)});
    }
    upper.push_back({notch_x, 0});
    Outline outline = outline_of(mirrored(upper));
    outline.notch = 3;
    // Beside the notch the mains follow their lobes.
    for (const std::size_t main : {std::size_t{3}, std::size_t{4}}) {
        const Vec2 middle{0, main == 3 ? off_axis : -off_axis};
        const Vec2 out = glm::normalize(outline.mains[main] - middle);
        outline.tangents[main] = {-out.y, out.x};
    }
    return outline;
}

}  // namespace culet
