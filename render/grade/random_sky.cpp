#include "render/grade/random_sky.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/optics/random.h"

namespace culet {

namespace {

constexpr double k_darkest = 0.2, k_spot_radiance = 15, k_spot_cosine = 0.999;

// Avoids spots behind the viewer, and on axes and diagonals, where symmetric stones would show them
// as one.
bool stands_free(const Vec3& d) {
    return std::abs(std::abs(d.x) - std::abs(d.y)) >= 0.1 && d.z >= 0.3 && d.z <= 0.94 &&
           !(d.y > -0.1 && std::abs(d.x) < 0.4) && std::abs(d.x) >= 0.05 && std::abs(d.y) >= 0.05;
}

}  // namespace

RandomSky::RandomSky(std::uint64_t seed, double n) {
    Random random(seed);
    const double brightness = (1 + std::sqrt(1.54 * n)) / 2.2;
    for (auto& row : patches_) {
        for (double& patch : row) patch = k_darkest + brightness * random.uniform();
    }
    patches_[k_patches / 2][k_patches / 2] = 0;
    while (spots_.size() < k_spots) {
        const double z = random.uniform(), angle = 2 * std::numbers::pi * random.uniform();
        const double r = std::sqrt(1 - z * z);
        const Vec3 spot{r * std::cos(angle), r * std::sin(angle), z};
        if (stands_free(spot)) spots_.push_back(spot);
    }
}

double RandomSky::radiance(const Vec3& direction) const {
    if (!(direction.z > 0)) return 0;
    for (const Vec3& spot : spots_) {
        if (glm::dot(spot, direction) > k_spot_cosine) return k_spot_radiance;
    }
    const double x = 0.5 * (k_patches - 1) * (direction.x + 1);
    const double y = 0.5 * (k_patches - 1) * (direction.y + 1);
    const int i = std::clamp(static_cast<int>(x), 0, k_patches - 2);
    const int j = std::clamp(static_cast<int>(y), 0, k_patches - 2);
    const double across = x - i, along = y - j;
    const auto patch = [&](int a, int b) {
        return patches_[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
    };
    const double near = (1 - across) * patch(i, j) + across * patch(i + 1, j);
    const double far = (1 - across) * patch(i, j + 1) + across * patch(i + 1, j + 1);
    return (1 - along) * near + along * far;
}

}  // namespace culet
