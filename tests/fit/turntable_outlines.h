#pragma once
// Outlines of a known stone on a turntable, with errors of a known size.

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "fit/silhouettes/projected_outline.h"
#include "fit/silhouettes/silhouette.h"

namespace culet::test {

struct Turntable {
    int views = 72;    ///< over the whole turn
    int points = 400;  ///< per outline, evenly spaced
    double sigma = 0;  ///< perpendicular to the outline
    unsigned seed = 1;
    Vec3 axis{0, 0, 1};
};

inline Contour seen_along(const Solid& solid, const Vec3& sight, const Turntable& turntable,
                          std::mt19937_64& random) {
    std::normal_distribution<double> normal(0, 1);
    const FlatContour frame = flattened(Contour{sight, {}, {}, 0}, 0);
    const ProjectedOutline outline = projected_outline(solid.vertices, frame.across, frame.along);
    double around = 0;
    for (const auto& e : outline.edges) around += e.length;
    Contour contour{sight, {}, {}, 0};
    double at = 0.5 * around / turntable.points, done = 0;
    for (const auto& e : outline.edges) {
        for (; at < done + e.length; at += around / turntable.points) {
            const double along = e.begin + (at - done);
            const double across = e.offset + turntable.sigma * normal(random);
            contour.points.push_back((e.tx * along + e.nx * across) * frame.across +
                                     (e.ty * along + e.ny * across) * frame.along);
            contour.weights.push_back(1);
        }
        done += e.length;
    }
    return contour;
}

inline SilhouetteSet turntable_outlines(const Solid& solid, const Turntable& turntable = {}) {
    std::mt19937_64 random(turntable.seed);
    SilhouetteSet set;
    for (int k = 0; k < turntable.views; ++k) {
        const double a = 2 * std::numbers::pi * k / turntable.views;
        set.contours.push_back(
            seen_along(solid, Vec3{std::cos(a), std::sin(a), 0}, turntable, random));
    }
    return set;
}

}  // namespace culet::test
