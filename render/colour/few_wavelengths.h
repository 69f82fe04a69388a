#pragma once
// Fits a few wavelengths to the whole spectrum of a coloured stone.
//
// The transmittance at three wavelengths says little about a stone's colour, because absorption
// bands lie between them. As Guy and Soler (Graphics Gems Revisited, 2004, equation 9) weight
// absorption for each primary of a screen, each wavelength gets a fitted absorption, and red, green
// and blue get fitted weights of the wavelengths. Light through the stone then has nearly the
// colour of the whole spectrum, for all path lengths at once.

#include <vector>

#include "render/colour/colour.h"
#include "stone/material/spectrum.h"

namespace culet {

/// Numbers of wavelengths that are fitted; larger sets sample the spectrum directly.
constexpr int k_least_fitted = 3, k_most_fitted = 15;

struct FewWavelengths {
    /// Per wavelength, in linear sRGB. The weights of each colour sum to 1.
    std::vector<Rgb> rgb_weight;
    /// [principal ray][wavelength]
    std::vector<std::vector<double>> absorption_per_mm;
};

/// Least squares of colour differences (a local CIEDE2000) of daylight after paths of up to five
/// widths along one principal ray and along all, and after paths spread exponentially about up to
/// four widths. With three wavelengths the light of each primary is fitted too.
/// `absorption_per_mm`: of each principal ray, one to three. The width is rounded to a quarter of
/// an octave (19 %), so that similar stones share one cached result.
const FewWavelengths& fit_wavelengths(const std::vector<Spectrum>& absorption_per_mm,
                                      const std::vector<double>& wavelengths_nm, double width_mm);

}  // namespace culet
