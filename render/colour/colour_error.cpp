#include "render/colour/colour_error.h"

#include <algorithm>
#include <cmath>

#include "render/colour/colour_difference.h"

namespace culet {

namespace {

constexpr double k_white_over_mean = 5;

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
    for (const Rgb& pixel : truth) error.mean += mean_of(pixel) / count;
    if (!(error.mean > 0)) return error;
    const double white = k_white_over_mean * error.mean;
    Moments radiance, delta_e;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const Rgb &a = seen[i], &b = truth[i];
        const double difference = apart(a, b);
        radiance.add(difference / error.mean);
        delta_e.add(difference > 0
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

ColourError noise_corrected_error(const std::array<std::vector<Rgb>, 2>& seen,
                                  const std::array<std::vector<Rgb>, 2>& truth) {
    std::vector<Rgb> mean_seen = seen[0], mean_truth = truth[0];
    double common = 0, squares = 0;
    for (std::size_t i = 0; i < mean_truth.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            const double one = seen[0][i][c] - truth[0][i][c],
                         other = seen[1][i][c] - truth[1][i][c];
            common += one * other;
            squares += std::pow(0.5 * (one + other), 2);
            mean_seen[i][c] = 0.5 * (seen[0][i][c] + seen[1][i][c]);
            mean_truth[i][c] = 0.5 * (truth[0][i][c] + truth[1][i][c]);
        }
    }
    ColourError error = colour_error(mean_seen, mean_truth);
    if (!(squares > 0)) return error;
    const double open = 1 / std::sqrt(static_cast<double>(mean_truth.size())),
                 share = std::sqrt(std::min(1.0, std::max(0.0, common) / squares + open));
    for (double* part :
         {&error.radiance, &error.radiance_spread, &error.delta_e, &error.delta_e_spread})
        *part *= share;
    return error;
}

}  // namespace culet
