#include "render/optics/merged_crystal.h"

#include <algorithm>
#include <cmath>

namespace culet {

namespace {

float number(double v) {
    return static_cast<float>(v);
}

}  // namespace

// The optic axes lie in the plane of the axes of the smallest and the largest index, at the angle V
// to the latter: sin^2 V = n3^2 (n2^2 - n1^2) / (n2^2 (n3^2 - n1^2)) (Born & Wolf, 15.3.1).
MergedCrystal merged_crystal(const Band& band, int node) {
    const Crystal& crystal = band.crystal;
    std::array<int, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return crystal.n()[a] < crystal.n()[b]; });
    const Vec3 &x = crystal.axes()[order[0]], &z = crystal.axes()[order[2]];
    const double n1 = crystal.n()[order[0]] * crystal.n()[order[0]],
                 n2 = crystal.n()[order[1]] * crystal.n()[order[1]],
                 n3 = crystal.n()[order[2]] * crystal.n()[order[2]];
    const double sine = std::sqrt(n3 * (n2 - n1) / (n2 * (n3 - n1))),
                 cosine = std::sqrt(n1 * (n3 - n2) / (n2 * (n3 - n1)));
    MergedCrystal merged;
    for (int i = 0; i < 2; ++i) {
        const Vec3 axis = (i == 0 ? sine : -sine) * x + cosine * z;
        for (int k = 0; k < 3; ++k) merged.optic_axis[i][k] = number(axis[k]);
    }
    merged.inverse_square[0] = number(0.5 * (1 / n1 + 1 / n3));
    merged.inverse_square[1] = number(0.5 * (n3 - n1) / (n1 * n3));
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) merged.principal[i][k] = number(crystal.axes()[i][k]);
        merged.absorption[i] = band.absorbs ? number(band.absorption[i][node]) : 0.0f;
    }
    if (band.coherence_length > 0) {
        merged.waves_per_length = number(1 / band.wavelength);
        merged.coherence_per_length = number(1 / band.coherence_length);
    }
    return merged;
}

}  // namespace culet
