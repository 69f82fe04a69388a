#pragma once
// Coherency matrix of two waves, for light of every polarisation at the eye.
//
// A path is traced backwards from the eye, which emits two orthonormal polarisations x and y. The
// two waves of a segment (s and p, or the modes of a crystal) then have amplitudes E_xm, E_ym, m =
// 0, 1, in units of the root of normal flux. By reciprocity (a face has the same amplitudes when
// every wave is reversed), light that comes the other way with amplitudes e_m reaches the eye as
// a_x = sum_m E_xm e_m, and likewise a_y. For partly coherent waves the averages <E_im conj(E_jn)>
// therefore suffice. Guy & Soler 2004, eq. 12, with transmission and reflection exchanged.

#include <Eigen/Core>

#include "render/optics/stokes.h"

namespace culet {

struct EyeCoherency {
    Eigen::Matrix2cd xx, yy, xy;  ///< [m][n] = <E_im conj(E_jn)>, ij = xx, yy, xy

    /// The eye's two polarisations are waves 0 and 1.
    static EyeCoherency of_eye() {
        EyeCoherency c;
        c.xx << 1, 0, 0, 0;
        c.yy << 0, 0, 0, 1;
        c.xy << 0, 1, 0, 0;
        return c;
    }

    /// Fraction of the eye's unpolarised power in wave m.
    double power(int m) const { return 0.5 * (xx(m, m).real() + yy(m, m).real()); }
    double power() const { return power(0) + power(1); }

    /// Transforms the amplitudes, E -> T E.
    EyeCoherency through(const Eigen::Matrix2cd& T) const {
        const Eigen::Matrix2cd back = T.adjoint();
        return {T * xx * back, T * yy * back, T * xy * back};
    }

    /// Wave m alone excites two waves with amplitudes t0, t1.
    EyeCoherency through_one(int m, std::complex<double> t0, std::complex<double> t1) const {
        const double p0 = std::norm(t0), p1 = std::norm(t1);
        const std::complex<double> mixed = t0 * std::conj(t1);
        const double x = xx(m, m).real(), y = yy(m, m).real();
        const std::complex<double> z = xy(m, m);
        EyeCoherency c;
        c.xx << x * p0, x * mixed, x * std::conj(mixed), x * p1;
        c.yy << y * p0, y * mixed, y * std::conj(mixed), y * p1;
        c.xy << z * p0, z * mixed, z * std::conj(mixed), z * p1;
        return c;
    }

    void scale(double factor) {
        xx *= factor;
        yy *= factor;
        xy *= factor;
    }
};

/// At the eye, for unpolarised light of radiance 1 in the two waves.
inline Stokes stokes_of_unpolarised(const EyeCoherency& c) {
    return stokes_of(0.5 * c.xx.trace().real(), 0.5 * c.yy.trace().real(), 0.5 * c.xy.trace());
}

/// At the eye, for light given relative to the two waves' vibrations (S1 > 0 along wave 0, ...).
inline Stokes stokes_of_light(const EyeCoherency& c, const Stokes& light) {
    const double j00 = 0.5 * (light[0] + light[1]), j11 = 0.5 * (light[0] - light[1]);
    const std::complex<double> j01(0.5 * light[2], 0.5 * light[3]);
    const auto seen = [&](const Eigen::Matrix2cd& m) {
        return m(0, 0) * j00 + m(1, 1) * j11 + m(0, 1) * j01 + m(1, 0) * std::conj(j01);
    };
    return stokes_of(seen(c.xx).real(), seen(c.yy).real(), seen(c.xy));
}

/// At the eye, for linearly polarised light of radiance 1 with field (e0, e1) in the two waves.
inline Stokes stokes_of_linear(const EyeCoherency& c, double e0, double e1) {
    const Eigen::Vector2d e(e0, e1);
    return stokes_of((e.transpose() * c.xx * e)(0).real(), (e.transpose() * c.yy * e)(0).real(),
                     (e.transpose() * c.xy * e)(0));
}

}  // namespace culet
