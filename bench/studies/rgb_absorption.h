#pragma once
// Absorption by three numbers instead of spectra, and to first order instead of exactly (Guy &
// Soler 2004, eqs. 8 and 9).

#include "render/colour/colour_difference.h"
#include "stone/material/material.h"

namespace culet {

/// (exp(-x) - (1 - x)) / exp(-x): by how much the first order is too dark.
double linear_absorption_error(double x);

/// The x for which exp(-x) - (1 - x) is `error`.
double thickness_of_linear_error(double error);

/// Daylight D65 after `length_mm` along principal ray number `ray`.
struct TransmittedColour {
    Lab spectral;    ///< from the spectrum, at every 5 nm
    Lab three;       ///< from its values at 610, 545 and 465 nm, as red, green and blue
    double delta_e;  ///< CIEDE2000
};
TransmittedColour transmitted_colour(const Material& material, std::size_t ray, double length_mm);

}  // namespace culet
