#include "render/colour/difference_near.h"

#include <cmath>
#include <cstddef>

#include "render/colour/colour_difference.h"

namespace culet {

DifferenceNear difference_near(double red, double green, double blue) {
    constexpr double k_change = 1e-5;
    const Lab at = lab_from_linear_srgb(red, green, blue);
    const double chroma = std::hypot(at.a, at.b), away = (at.L - 50) * (at.L - 50);
    const double cosine = chroma > 0 ? at.a / chroma : 1, sine = chroma > 0 ? at.b / chroma : 0;
    const double S_L = 1 + 0.015 * away / std::sqrt(20 + away), S_C = 1 + 0.045 * chroma,
                 S_H = 1 + 0.015 * chroma;
    DifferenceNear rows{};
    for (std::size_t c = 0; c < 3; ++c) {
        const Lab to =
            lab_from_linear_srgb(red + (c == 0 ? k_change : 0), green + (c == 1 ? k_change : 0),
                                 blue + (c == 2 ? k_change : 0));
        const double da = (to.a - at.a) / k_change, db = (to.b - at.b) / k_change;
        rows[0][c] = (to.L - at.L) / k_change / S_L;
        rows[1][c] = (cosine * da + sine * db) / S_C;
        rows[2][c] = (cosine * db - sine * da) / S_H;
    }
    return rows;
}

}  // namespace culet
