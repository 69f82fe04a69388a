#pragma once
// Stokes parameters at the eye.

#include <array>
#include <complex>

namespace culet {

/// Stokes parameters as the eye sees them: S1 > 0 along the picture's x (to the right), S2 > 0 at
/// 45 degrees (to the upper right), S3 > 0 turning clockwise for who looks towards the light (right
/// circular: Born & Wolf, Principles of Optics, 1.4.2).
using Stokes = std::array<double, 4>;

/// From the coherency <a_i conj(a_j)> of the amplitudes along x and y.
inline Stokes stokes_of(double xx, double yy, std::complex<double> xy) {
    return {xx + yy, xx - yy, 2 * xy.real(), 2 * xy.imag()};
}

}  // namespace culet
