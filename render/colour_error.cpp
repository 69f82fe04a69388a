#include "render/colour_error.h"

#include <algorithm>
#include <cmath>

#include "render/colour_difference.h"

namespace culet {

namespace {

constexpr double k_white_over_mean = 5;

// Mean, and its standard error.
struct Moments {
    double sum = 0, squares = 0;

    void add(double v) {
        sum += v;
        squares += v * v;
    }
    double mean(double count) const { return sum / count; }
    double spread(double count) const {
        if (count < 2) return 0;
        const double variance = (squares - sum * sum / count) / (count - 1);
        return std::sqrt(std::max(0.0, variance) / count);
    }
};

}  // namespace

ColourError colour_error(const std::vector<Rgb>& seen, const std::vector<Rgb>& truth) {
    ColourError error;
    const double count = static_cast<double>(truth.size());
    for (const Rgb& pixel : truth) error.mean += (pixel[0] + pixel[1] + pixel[2]) / (3 * count);
    if (!(error.mean > 0)) return error;
    const double white = k_white_over_mean * error.mean;
    Moments radiance, delta_e;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const Rgb &a = seen[i], &b = truth[i];
        const double apart = std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
        radiance.add(apart / (3 * error.mean));
        delta_e.add(apart > 0
                        ? ciede2000(lab_from_linear_srgb(a[0] / white, a[1] / white, a[2] / white),
                                    lab_from_linear_srgb(b[0] / white, b[1] / white, b[2] / white))
                        : 0.0);
    }
    error.radiance = radiance.mean(count);
    error.radiance_spread = radiance.spread(count);
    error.delta_e = delta_e.mean(count);
    error.delta_e_spread = delta_e.spread(count);
    return error;
}

}  // namespace culet
