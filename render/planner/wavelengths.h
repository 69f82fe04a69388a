#pragma once
// Sets of wavelengths that a picture may be drawn with where the scene names none.

#include <array>
#include <vector>

namespace culet {

/// Sets to choose from. All but the finest are part of that of 29, all but that of 5 of that of 15.
inline constexpr std::array k_wavelength_counts{3, 5, 8, 15, 29, 57};

/// Three carry any colour of light.
inline const std::vector<double> k_three_nm{450, 550, 610};

/// The set of so many.
std::vector<double> even_wavelengths(int count);

/// Turns that the rays of a pixel take with so many wavelengths: four at a time bring nearly as
/// much as all of them, and each at least twice.
int turns_for(int rays, int wavelengths);

}  // namespace culet
