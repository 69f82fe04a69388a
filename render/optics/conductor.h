#pragma once
// Reflectance of metals for unpolarised light: Fresnel's equations for the index n + i k, without
// phases (Born & Wolf, 14.2).

#include <algorithm>
#include <cmath>

namespace culet {

/// Mean of s and p. `n`, `k`: relative to the outside; infinite k reflects all.
inline double conductor_reflectance(double n, double k, double cosine) {
    if (std::isinf(k)) return 1;
    // a + i b is the root of (n + i k)^2 - sin^2, and a^2 + b^2 the modulus of its square.
    const double c2 = cosine * cosine, s2 = (1 - cosine) * (1 + cosine);
    const double re = (n - k) * (n + k) - s2, im = 2 * n * k;
    const double squares = std::sqrt(re * re + im * im);
    const double a = std::sqrt(std::max(0.0, 0.5 * (squares + re)));
    const double sum = squares + c2, mixed = 2 * a * cosine;
    const double R_s = (sum - mixed) / (sum + mixed);
    const double p_sum = c2 * squares + s2 * s2, p_mixed = mixed * s2;
    const double R_p = p_sum + p_mixed > 0 ? R_s * (p_sum - p_mixed) / (p_sum + p_mixed) : R_s;
    return std::isfinite(R_s + R_p) ? 0.5 * (R_s + R_p) : 1;
}

/// k of the index 1 + i k that has this reflectance at normal incidence, r = k^2 / (4 + k^2);
/// infinite for 1.
inline double extinction_of_reflectance(double reflectance) {
    return 2 * std::sqrt(reflectance / (1 - reflectance));
}

}  // namespace culet
