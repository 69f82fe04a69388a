#pragma once
// What a few wavelengths of a coloured stone stand for.
//
// The transmittance at three wavelengths says little about a stone's colour: its bands of
// absorption lie between them. As Guy and Soler (Graphics Gems Revisited, 2004, equation 9) weigh
// absorption for each primary of a screen, each wavelength gets the absorption, and each red, green
// and blue the shares of wavelengths, with which the colour of light that went through the stone is
// that of the whole spectrum, as nearly as can be for all lengths of a path at once.

#include <vector>

#include "render/colour/colour.h"
#include "stone/material/spectrum.h"

namespace culet {

/// Sets of so many wavelengths are fitted; more show a spectrum as it is.
constexpr int k_least_fitted = 3, k_most_fitted = 15;

struct FewWavelengths {
    /// Of each wavelength: its share in linear sRGB. The shares of each colour sum to 1.
    std::vector<Rgb> rgb_weight;
    /// For each principal ray, at each wavelength.
    std::vector<std::vector<double>> absorption_per_mm;
};

/// The least squares of the differences in colour (a local CIEDE2000) of daylight after ways of up
/// to five widths along one principal ray and along all of them, and after ways that are spread
/// exponentially about up to four widths; with three wavelengths of the light of each primary as
/// well. `absorption_per_mm`: of each principal ray, one to three. The width counts in steps of a
/// fifth, so that stones of nearly one size have one result, which is kept.
const FewWavelengths& few_wavelengths(const std::vector<Spectrum>& absorption_per_mm,
                                      const std::vector<double>& wavelengths_nm, double width_mm);

}  // namespace culet
