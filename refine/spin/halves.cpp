#include "refine/spin/halves.h"

#include <algorithm>
#include <cmath>

#include "refine/spin/stone_attitude.h"
#include "stone/numbers/units.h"
#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

constexpr double k_told = radians(2.0);
// Facets further apart are different ones.
constexpr double k_same = radians(4.0);
// The median length of a random vector of two components, each of sigma 1.
const double k_median_length = std::sqrt(2 * std::log(2.0));

}  // namespace

std::vector<bool> seen_facets(const TurningFit& fit) {
    std::vector<bool> seen;
    for (const double sigma : fit.tilt_sigmas) seen.push_back(sigma <= k_turning_tilt / 2);
    return seen;
}

Halves compared(const TurningFit& one, const TurningFit& other) {
    Halves halves;
    std::vector<double> tilts, parts;
    for (std::size_t f = 0; f < one.solid.facets.size(); ++f) {
        double nearest = k_same, sigma = HUGE_VAL;
        for (std::size_t g = 0; g < other.solid.facets.size(); ++g) {
            const double angle =
                angle_between(one.solid.facets[f].plane.normal, other.solid.facets[g].plane.normal);
            if (!(angle < nearest)) continue;
            nearest = angle;
            sigma = std::max(one.tilt_sigmas[f], other.tilt_sigmas[g]);
        }
        if (!(sigma < k_told)) continue;
        tilts.push_back(nearest);
        parts.push_back(nearest / (std::sqrt(2.0) * sigma));
    }
    halves.facets = int(tilts.size());
    if (!tilts.empty()) {
        halves.tilt = upper_median(tilts);
        halves.factor = std::max(1.0, upper_median(parts) / k_median_length);
    }
    const StoneAttitude a = attitude_of(one.solid, seen_facets(one), {0, 0, 1}),
                        b = attitude_of(other.solid, seen_facets(other), {0, 0, 1});
    halves.up = angle_between(a.z, b.z);
    halves.width = 2 * (a.width - b.width) / (a.width + b.width);
    halves.length_to_width =
        2 * (a.length / a.width - b.length / b.width) / (a.length / a.width + b.length / b.width);
    halves.elevation = one.series.camera.elevation - other.series.camera.elevation;
    return halves;
}

}  // namespace culet
