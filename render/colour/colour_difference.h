#pragma once
// Perceived colour differences: CIELAB and CIEDE2000.

#include <array>

namespace culet {

/// CIE 1976 L*, a*, b* (CIE 15:2004, 8.2.1) for the white point D65.
struct Lab {
    double L = 0, a = 0, b = 0;
};

/// From linear sRGB, 1 being the white point (IEC 61966-2-1 matrix).
Lab lab_from_linear_srgb(double red, double green, double blue);

/// CIEDE2000 with kL = kC = kH = 1; symmetric, 0 for equal colours. Formulas and test data: Sharma,
/// Wu and Dalal, "The CIEDE2000 color-difference formula" (2005), equations 2 to 22.
double ciede2000(const Lab& first, const Lab& second);

}  // namespace culet
