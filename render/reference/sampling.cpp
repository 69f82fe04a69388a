#include "render/reference/sampling.h"

#include <cmath>
#include <numbers>

namespace culet {

namespace {

// Quantile of a filter: the offset from the pixel's middle, in filter radii, below which the part
// `u` lies.
double filtered(PixelFilter filter, double u) {
    switch (filter) {
        case PixelFilter::box:
            return 2 * u - 1;
        case PixelFilter::tent:
            return u < 0.5 ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u);
        case PixelFilter::gaussian: {
            // Truncated at two standard deviations. Bisection suffices: it runs once per picture.
            const double whole = std::erf(std::numbers::sqrt2);
            double low = -1, high = 1;
            for (int i = 0; i < 60; ++i) {
                const double middle = 0.5 * (low + high);
                const double share = 0.5 * (1 + std::erf(std::numbers::sqrt2 * middle) / whole);
                (share < u ? low : high) = middle;
            }
            return 0.5 * (low + high);
        }
    }
    return 0;
}

}  // namespace

std::vector<SamplePoint> sample_pattern(int count, bool pupil, PixelFilter filter,
                                        double filter_radius) {
    std::vector<SamplePoint> points;
    const int side = static_cast<int>(std::lround(std::sqrt(count)));
    const bool square = side * side == count;
    constexpr double k_phi2 = 1.32471795724474602596, k_phi4 = 1.16730397826141868426;
    for (int i = 0; i < count; ++i) {
        double u = 0, v = 0;
        if (square) {
            u = (i % side + 0.5) / side;
            v = (i / side + 0.5) / side;
        } else {
            u = std::fmod(0.5 + (i + 1) / k_phi2, 1.0);
            v = std::fmod(0.5 + (i + 1) / (k_phi2 * k_phi2), 1.0);
        }
        SamplePoint p;
        p.x = 0.5 + filter_radius * filtered(filter, u);
        p.y = 0.5 + filter_radius * filtered(filter, v);
        if (pupil) {
            const double radius = std::sqrt(std::fmod(0.5 + (i + 1) / k_phi4, 1.0));
            const double angle =
                2 * std::numbers::pi * std::fmod(0.5 + (i + 1) / (k_phi4 * k_phi4), 1.0);
            p.pupil_x = radius * std::cos(angle);
            p.pupil_y = radius * std::sin(angle);
        }
        points.push_back(p);
    }
    return points;
}

}  // namespace culet
