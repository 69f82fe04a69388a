#pragma once
// Stokes parameters at the eye.

#include <array>
#include <cmath>
#include <complex>

namespace culet {

/// Stokes parameters as the eye sees them: S1 > 0 along the picture's x (to the right), S2 > 0 at
/// 45 degrees (to the upper right), S3 > 0 clockwise when looking towards the light (right
/// circular: Born & Wolf, Principles of Optics, 1.4.2).
using Stokes = std::array<double, 4>;

/// From the coherency <a_i conj(a_j)> of the amplitudes along x and y.
inline Stokes stokes_of(double xx, double yy, std::complex<double> xy) {
    return {xx + yy, xx - yy, 2 * xy.real(), 2 * xy.imag()};
}

/// The physical Stokes vector (S0 >= length of the polarised part) nearest to a noisy estimate. It
/// is never farther from the true value (projection onto a convex cone: Boyd & Vandenberghe 2004,
/// 8.1).
inline Stokes nearest_light(const Stokes& s) {
    const double polarised = std::hypot(s[1], s[2], s[3]);
    if (polarised <= s[0]) return s;
    if (polarised <= -s[0]) return {};
    const double whole = (s[0] + polarised) / 2, part = whole / polarised;
    return {whole, part * s[1], part * s[2], part * s[3]};
}

}  // namespace culet
