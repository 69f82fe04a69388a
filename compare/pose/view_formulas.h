#pragma once
// A view's formulas, also for automatic differentiation.

#include <array>
#include <cmath>

namespace culet {

/// The rotation by the vector w, row by row (Rodrigues 1840).
template <class Number>
std::array<Number, 9> rotation_of(const Number& x, const Number& y, const Number& z) {
    using std::cos;
    using std::sin;
    using std::sqrt;
    const Number squared = x * x + y * y + z * z;
    Number a(1), b(0.5);  // sin(t) / t and (1 - cos(t)) / t^2
    if (squared > 1e-16) {
        const Number angle = sqrt(squared);
        a = sin(angle) / angle;
        b = (Number(1) - cos(angle)) / squared;
    }
    return {
        Number(1) - b * (y * y + z * z), b * x * y - a * z, b * x * z + a * y, b * x * y + a * z,
        Number(1) - b * (x * x + z * z), b * y * z - a * x, b * x * z - a * y, b * y * z + a * x,
        Number(1) - b * (x * x + y * y)};
}

/// The smallest rotation that takes z to the direction (x, y, 1), row by row.
template <class Number>
std::array<Number, 9> least_rotation_to(const Number& x, const Number& y) {
    using std::sqrt;
    const Number cosine = Number(1) / sqrt(Number(1) + x * x + y * y);
    const Number dx = x * cosine, dy = y * cosine;
    const Number share = Number(1) / (Number(1) + cosine);
    return {Number(1) - share * dx * dx,
            -share * dx * dy,
            dx,
            -share * dx * dy,
            Number(1) - share * dy * dy,
            dy,
            -dx,
            -dy,
            cosine};
}

template <class Number>
std::array<Number, 3> times(const std::array<Number, 9>& rows, const std::array<Number, 3>& p) {
    return {rows[0] * p[0] + rows[1] * p[1] + rows[2] * p[2],
            rows[3] * p[0] + rows[4] * p[1] + rows[5] * p[2],
            rows[6] * p[0] + rows[7] * p[1] + rows[8] * p[2]};
}

}  // namespace culet
