#include "compare/scores/chance.h"

#include <cmath>
#include <numbers>

namespace culet {

double Chance::normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
}

Vec3 Chance::direction() {
    const double z = uniform(-1, 1), angle = 2 * std::numbers::pi * uniform();
    const double across = std::sqrt(1 - z * z);
    return {across * std::cos(angle), across * std::sin(angle), z};
}

std::uint64_t seed_of(std::uint64_t seed, std::uint64_t group, std::uint64_t draw) {
    const auto mixed = [](std::uint64_t x) {
        x += 0x9e3779b97f4a7c15u;
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
        return x ^ (x >> 31);
    };
    return mixed(mixed(mixed(seed) + group) + draw);
}

glm::dmat3 rotation_about(const Vec3& axis, double angle) {
    // Rodrigues (1840). glm's matrices are lists of columns.
    const double c = std::cos(angle), s = std::sin(angle), d = 1 - c;
    const Vec3& a = axis;
    return glm::dmat3(c + d * a.x * a.x, d * a.x * a.y + s * a.z, d * a.x * a.z - s * a.y,
                      d * a.x * a.y - s * a.z, c + d * a.y * a.y, d * a.y * a.z + s * a.x,
                      d * a.x * a.z + s * a.y, d * a.y * a.z - s * a.x, c + d * a.z * a.z);
}

}  // namespace culet
