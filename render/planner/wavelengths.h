#pragma once
// Sets of wavelengths for pictures of scenes that name none.

#include <array>
#include <vector>

namespace culet {

/// Sizes of the sets. All but the finest are subsets of the set of 29, all but that of 5 of the set
/// of 15.
inline constexpr std::array k_wavelength_counts{3, 5, 8, 15, 29, 57};

/// Three represent any colour of light.
inline const std::vector<double> k_three_nm{450, 550, 610};

/// The set of `count` wavelengths.
std::vector<double> even_wavelengths(int count);

/// Turns in which the rays of a pixel share the wavelengths: about four per ray carry nearly as
/// much as all, and each turn comes up at least twice.
int turns_for(int rays, int wavelengths);

}  // namespace culet
