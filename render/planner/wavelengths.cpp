#include "render/planner/wavelengths.h"

#include <algorithm>

#include "render/setup/probe_wavelengths.h"

namespace culet {

std::vector<double> even_wavelengths(int count) {
    // Small sets sample the middle of the eye's responses rather than the ends of the spectrum.
    // Dispersion spreads a light's edge over a pixel; of sets of five, this one approximates such a
    // step of the spectrum better than even spacing, and a lamp's spectrum about as well.
    if (count == 3) return {450, 550, 610};
    if (count == 5) return {440, 480, 540, 600, 650};
    return even_nodes(count);
}

int turns_for(int rays, int wavelengths) {
    return std::max(1, std::min(rays / 2, wavelengths / 4 + 1));
}

}  // namespace culet
