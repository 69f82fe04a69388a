#pragma once
// Colour error of some pixels against the reference, with its standard error.

#include <array>
#include <cmath>
#include <vector>

#include "render/colour/colour.h"

namespace culet {

/// Mean absolute difference of R, G and B.
inline double apart(const Rgb& a, const Rgb& b) {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum += std::abs(a[c] - b[c]);
    return sum / 3;
}
inline double mean_of(const Rgb& rgb) {
    return (rgb[0] + rgb[1] + rgb[2]) / 3;
}

/// Error over some pixels. `radiance`: mean of the mean absolute difference of R, G and B, relative
/// to `mean`; `delta_e`: mean CIEDE2000 on a screen whose white is five times `mean` (middle grey
/// is a fifth of white).
struct ColourError {
    double mean = 0;  ///< of R, G and B of the reference pixels
    double radiance = 0, delta_e = 0;
    /// Standard errors of the two means, for randomly chosen pixels.
    double radiance_spread = 0, delta_e_spread = 0;

    double bound() const { return radiance + 3 * radiance_spread; }
    double bound_delta_e() const { return delta_e + 3 * delta_e_spread; }
};

/// The vectors have one size. All results are 0 if no pixel is lit.
ColourError colour_error(const std::vector<Rgb>& seen, const std::vector<Rgb>& truth);

/// The same for pixels drawn twice, independently, with few rays. Their noise exceeds the picture's
/// error, so the error of the runs' mean is scaled by the part that both have in common. For P
/// pixels that part is uncertain by 1/sqrt(P) of the squares, which is added.
ColourError noise_corrected_error(const std::array<std::vector<Rgb>, 2>& seen,
                                  const std::array<std::vector<Rgb>, 2>& truth);

}  // namespace culet
