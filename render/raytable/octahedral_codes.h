#pragma once
// Unit directions as two integers: octahedral coordinates (Meyer et al. 2010; Cigolle et al. 2014),
// the square -1..1 in steps of 1 / (2^31 - 1).
//
// Error: each coordinate is off by at most half a step, d = 2^-32. The point on the octahedron
// moves by at most |(d, d, 2 d)| = sqrt(6) d and lies at least 1 / sqrt(3) from the centre, so the
// direction is off by at most sqrt(18) d, 1e-9 radians.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

#include "stone/solid/solid.h"

namespace culet {

constexpr double k_octahedral_steps = 2147483647.0;

using DirectionCode = std::array<std::int32_t, 2>;

/// `d` need not be a unit vector.
inline DirectionCode octahedral_code(const Vec3& d) {
    const double scale = 1 / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
    double a = d.x * scale, b = d.y * scale;
    if (d.z < 0) {
        const double folded = std::copysign(1 - std::abs(b), a);
        b = std::copysign(1 - std::abs(a), b);
        a = folded;
    }
    const auto code = [](double v) {
        return static_cast<std::int32_t>(
            std::llround(std::clamp(v, -1.0, 1.0) * k_octahedral_steps));
    };
    return {code(a), code(b)};
}

/// Returns a unit vector for every code.
inline Vec3 octahedral_direction(const DirectionCode& code) {
    Vec3 d{code[0] / k_octahedral_steps, code[1] / k_octahedral_steps, 0};
    d.z = 1 - std::abs(d.x) - std::abs(d.y);
    const double below = std::max(-d.z, 0.0);
    d.x -= std::copysign(below, d.x);
    d.y -= std::copysign(below, d.y);
    return glm::normalize(d);
}

}  // namespace culet
