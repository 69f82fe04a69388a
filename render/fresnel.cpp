#include "render/fresnel.h"

#include <algorithm>
#include <cmath>

namespace culet {

FaceAmplitudes fresnel(double n1, double n2, double q1) {
    FaceAmplitudes face;
    const double e1 = n1 * n1, e2 = n2 * n2;
    q1 = std::clamp(q1, 0.0, n1);
    const double k_squared = (n1 - q1) * (n1 + q1);
    // q2^2 = n2^2 - K^2 with K^2 = n1^2 - q1^2, as products of sums and differences.
    const double q2_squared = (n2 - n1) * (n2 + n1) + q1 * q1;
    if (q2_squared > 0) {
        const double q2 = std::sqrt(q2_squared);
        const double s = q1 + q2, p = e2 * q1 + e1 * q2;
        // The plain differences keep r^2 + t^2 = 1 next to the critical angle, where q2 has few
        // digits; the rationalised ones keep the digits of a small r, next to Brewster's angle and
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
        // Evanescent beyond the face: q2 = i kappa.
        const std::complex<double> i_kappa(0.0, std::sqrt(-q2_squared));
        face.total = true;
        if (q1 == 0) {
            // Grazing: both limits are -1.
            face.r_s = -1;
            face.r_p = -1;
        } else {
            face.r_s = (q1 - i_kappa) / (q1 + i_kappa);
            face.r_p = (e2 * q1 - e1 * i_kappa) / (e2 * q1 + e1 * i_kappa);
        }
    }
    return face;
}

}  // namespace culet
