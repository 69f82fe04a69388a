#include "bench/studies/wave_angles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/optics/crystal.h"

namespace culet {

namespace {

constexpr double k_pi = std::numbers::pi;

double angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

WaveAngle at(double n_o, double n_e, double incidence, double polar, double azimuth) {
    const Vec3 into{0, 0, 1}, K{std::sin(incidence), 0, 0};
    WaveAngle found;
    found.incidence = incidence;
    found.axis = {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                  std::cos(polar)};
    const auto modes = modes_towards(uniaxial_crystal(found.axis, n_o, n_e), K, into);
    const double mean = 0.5 * (n_o + n_e);
    const Vec3 merged{K.x / mean, 0, std::sqrt((1 - K.x / mean) * (1 + K.x / mean))};
    found.angle = angle_between(modes[0].ray, modes[1].ray);
    found.from_merged =
        std::max(angle_between(merged, modes[0].ray), angle_between(merged, modes[1].ray));
    return found;
}

}  // namespace

WaveAngle largest_wave_angle(double n_o, double n_e) {
    // A grid over the whole range, then ever finer ones about the best so far. Turning the axis by
    // 180 degrees changes nothing, nor does mirroring it in the plane of incidence.
    constexpr int k_steps = 18, k_rounds = 40;
    double middle[3] = {k_pi / 4, k_pi / 2, k_pi / 2}, half[3] = {k_pi / 4, k_pi / 2, k_pi / 2};
    WaveAngle best;
    for (int round = 0; round < k_rounds; ++round) {
        double at_best[3] = {middle[0], middle[1], middle[2]};
        const int steps = round == 0 ? k_steps : 4;
        const auto value = [&](int of, int step) {
            return middle[of] + half[of] * (2.0 * step / steps - 1);
        };
        for (int i = 0; i <= steps; ++i)
            for (int j = 0; j <= steps; ++j)
                for (int k = 0; k <= steps; ++k) {
                    const double incidence = std::clamp(value(0, i), 0.0, k_pi / 2);
                    const WaveAngle here = at(n_o, n_e, incidence, value(1, j), value(2, k));
                    if (here.angle <= best.angle) continue;
                    best = here;
                    at_best[0] = incidence;
                    at_best[1] = value(1, j);
                    at_best[2] = value(2, k);
                }
        for (int of = 0; of < 3; ++of) {
            middle[of] = at_best[of];
            half[of] *= round == 0 ? 2.0 / k_steps : 0.6;
        }
    }
    return best;
}

double first_order_wave_angle(double n_o, double n_e) {
    const double n = 0.5 * (n_o + n_e), t = 1 / std::sqrt((n - 1) * (n + 1));
    return std::abs(n_e - n_o) / n * 0.5 * (t + std::sqrt(4 + t * t));
}

}  // namespace culet
