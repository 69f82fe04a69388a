#pragma once
// How far some pixels are from what they should be, and how sure that is.

#include <array>
#include <cmath>
#include <vector>

#include "render/colour/colour.h"

namespace culet {

/// Mean absolute difference, and mean, of R, G and B.
inline double apart(const Rgb& a, const Rgb& b) {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum += std::abs(a[c] - b[c]);
    return sum / 3;
}
inline double mean_of(const Rgb& rgb) {
    return (rgb[0] + rgb[1] + rgb[2]) / 3;
}

/// Over some pixels of a picture. `radiance`: mean of the mean absolute difference of R, G and B,
/// relative to `mean`; `delta_e`: mean CIEDE2000 as on a screen whose white is five times `mean`
/// (middle grey is a fifth of white).
struct ColourError {
    double mean = 0;  ///< of R, G and B of the true pixels
    double radiance = 0, delta_e = 0;
    /// Standard errors of the two means, as of pixels chosen at random.
    double radiance_spread = 0, delta_e_spread = 0;

    /// With three standard errors.
    double bound() const { return radiance + 3 * radiance_spread; }
    double bound_delta_e() const { return delta_e + 3 * delta_e_spread; }
};

/// Both of one size. All 0 where no pixel is lit.
ColourError colour_error(const std::vector<Rgb>& seen, const std::vector<Rgb>& truth);

/// The same of pixels that were drawn twice with few rays each, independently. Colours of single
/// rays are far stronger than those of a pixel: of the mean of both differences, the share that
/// the two have in common. What the products of P pixels leave open of that, 1/sqrt(P) of the
/// squares, counts as common.
ColourError error_in_common(const std::array<std::vector<Rgb>, 2>& seen,
                            const std::array<std::vector<Rgb>, 2>& truth);

}  // namespace culet
