#include "bench/studies/rgb_absorption.h"

#include <cmath>

#include "render/colour/colour.h"

namespace culet {

double linear_absorption_error(double x) {
    return 1 - (1 - x) * std::exp(x);
}

double thickness_of_linear_error(double error) {
    // exp(-x) - 1 + x increases with x: Newton's method from its leading term, x^2 / 2.
    double x = std::sqrt(2 * error);
    for (int i = 0; i < 50; ++i) x -= (std::expm1(-x) + x - error) / -std::expm1(-x);
    return x;
}

TransmittedColour transmitted_colour(const Material& material, std::size_t ray, double length_mm) {
    const Spectrum& absorption = material.absorption_per_mm[ray];
    std::vector<double> wavelengths;
    for (int nm = 380; nm <= 780; nm += 5) wavelengths.push_back(nm);
    const WavelengthSet set(wavelengths);
    std::vector<double> radiance;
    for (const double nm : wavelengths)
        radiance.push_back(std::exp(-absorption.at(nm) * length_mm));
    const Rgb rgb = set.rgb_of(radiance.data());
    TransmittedColour colour;
    colour.spectral = lab_from_linear_srgb(rgb[0], rgb[1], rgb[2]);
    const auto left = [&](double nm) { return std::exp(-absorption.at(nm) * length_mm); };
    colour.three = lab_from_linear_srgb(left(610), left(545), left(465));
    colour.delta_e = ciede2000(colour.spectral, colour.three);
    return colour;
}

}  // namespace culet
