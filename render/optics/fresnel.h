#pragma once
// One face between two isotropic media.
//
// Fields ~ exp(i k0 N.r - i w t). A wave has the wave vector N (length: refractive index). K is its
// tangential part, the same on both sides (Snell's law), and q its normal part, q = n cos. For
// every wave at the face, s = K x normal / |K x normal| and p = N/|N| x s, so r_p = -r_s at normal
// incidence. Formulas: Born & Wolf, Principles of Optics, 1.5, rearranged to avoid cancellation for
// n1 ~ n2, at Brewster's angle and next to the critical angle.

#include <algorithm>
#include <cmath>
#include <complex>

namespace culet {

/// (re + i im) / (re - i im), of modulus 1.
inline std::complex<double> over_its_conjugate(double re, double im) {
    const double scale = 1 / (re * re + im * im);
    return {(re - im) * (re + im) * scale, 2 * re * im * scale};
}

struct FaceAmplitudes {
    std::complex<double> r_s, r_p;  ///< reflected over incident field
    double t_s = 0, t_p = 0;        ///< transmitted amplitude in units of the root of normal flux
    double q2 = 0;                  ///< q of the transmitted wave; 0 if there is none
    bool total = false;             ///< total reflection: |r| = 1, t = 0
};

/// `n1`, `n2`: indices on the incident side and beyond; `q1` = n1 cos(incidence), 0..n1. r_s^2 +
/// t_s^2 = 1 and r_p^2 + t_p^2 = 1 to rounding.
inline FaceAmplitudes fresnel(double n1, double n2, double q1) {
    FaceAmplitudes face;
    const double e1 = n1 * n1, e2 = n2 * n2;
    q1 = std::clamp(q1, 0.0, n1);
    const double k_squared = (n1 - q1) * (n1 + q1);
    // q2^2 = n2^2 - K^2 with K^2 = n1^2 - q1^2, in factored form.
    const double q2_squared = (n2 - n1) * (n2 + n1) + q1 * q1;
    if (q2_squared > 0) {
        const double q2 = std::sqrt(q2_squared);
        const double s = q1 + q2, p = e2 * q1 + e1 * q2;
        // The plain differences keep r^2 + t^2 = 1 next to the critical angle, where q2 has few
        // digits. The rationalised ones keep the digits of a small r, next to Brewster's angle and
        // for n1 ~ n2.
        constexpr double k_small = 0.1;
        const double s_difference = q1 - q2, p_difference = e2 * q1 - e1 * q2;
        face.r_s = std::abs(s_difference) > k_small * s ? s_difference / s : (e1 - e2) / (s * s);
        face.r_p = std::abs(p_difference) > k_small * p
                       ? p_difference / p
                       : (e2 - e1) * (e1 * e2 - k_squared * (e1 + e2)) / (p * p);
        const double root = 2 * std::sqrt(q1 * q2);
        face.t_s = root / s;
        face.t_p = n1 * n2 * root / p;
        face.q2 = q2;
    } else {
        // The wave beyond the face is evanescent: q2 = i kappa.
        const double kappa = std::sqrt(-q2_squared);
        face.total = true;
        if (q1 == 0) {
            // At grazing incidence both limits are -1.
            face.r_s = -1;
            face.r_p = -1;
        } else {
            face.r_s = over_its_conjugate(q1, -kappa);
            face.r_p = over_its_conjugate(e2 * q1, -e1 * kappa);
        }
    }
    return face;
}

/// Reflection of unpolarised light, like `fresnel` without phases and transmitted amplitudes.
struct FaceReflection {
    double mean = 1;  ///< mean power of s and p
    double q2 = 0;    ///< as in FaceAmplitudes
    bool total = true;
};
inline FaceReflection mean_reflection(double n1, double n2, double q1) {
    FaceReflection face;
    const double e1 = n1 * n1, e2 = n2 * n2;
    q1 = std::clamp(q1, 0.0, n1);
    const double q2_squared = (n2 - n1) * (n2 + n1) + q1 * q1;
    if (!(q2_squared > 0)) return face;
    const double q2 = std::sqrt(q2_squared);
    // A small r is squared, so its lost digits do not matter: plain differences suffice.
    const double r_s = (q1 - q2) / (q1 + q2), r_p = (e2 * q1 - e1 * q2) / (e2 * q1 + e1 * q2);
    face.mean = 0.5 * (r_s * r_s + r_p * r_p);
    face.q2 = q2;
    face.total = false;
    return face;
}

/// Reflectance of a ground face for light from all directions of the side of index 1, by Lambert's
/// law; `n` >= 1 beyond. Of light from the other side it is 1 - (1 - this) / n^2, since a face in
/// equal light on both sides (per squared index) passes as much either way.
inline double diffuse_reflectance(double n) {
    constexpr int k_cosines = 32;
    double sum = 0;
    for (int i = 0; i < k_cosines; ++i) {
        // Denser towards grazing light, where it changes most: the cosine is t^2.
        const double t = (i + 0.5) / k_cosines;
        sum += 4 * t * t * t / k_cosines * mean_reflection(1, n, t * t).mean;
    }
    return sum;
}

}  // namespace culet
