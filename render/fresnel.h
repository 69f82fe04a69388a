#pragma once
// One face between two isotropic media.
//
// Fields ~ exp(i k0 N.r - i w t). A wave has the wave vector N (length: refractive index); K is its
// tangential part, the same on both sides (Snell's law), and q its part along the normal, q = n
// cos. s = K x normal / |K x normal| and p = N/|N| x s for every wave at the face, so that r_p =
// -r_s at normal incidence. Formulas: Born & Wolf, Principles of Optics, 1.5, rearranged so that
// nothing cancels for n1 ~ n2, at Brewster's angle or next to the critical angle.

#include <complex>

namespace culet {

struct FaceAmplitudes {
    std::complex<double> r_s, r_p;  ///< reflected over incident field
    double t_s = 0, t_p = 0;        ///< transmitted amplitude in units of the root of normal flux
    double q2 = 0;                  ///< q of the transmitted wave; 0 when there is none
    bool total = false;             ///< total reflection: |r| = 1, t = 0
};

/// `n1`, `n2`: indices on the side of the incident wave and beyond; `q1` = n1 cos(incidence),
/// 0..n1. r_s^2 + t_s^2 = 1 and r_p^2 + t_p^2 = 1 to rounding.
FaceAmplitudes fresnel(double n1, double n2, double q1);

}  // namespace culet
