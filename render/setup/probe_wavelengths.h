// Where a material is looked at before its scene is drawn.
#pragma once

namespace culet {

// Where the eye's response is, and how many wavelengths, evenly spread there, a material is asked
// at.
inline constexpr double k_first_nm = 410, k_last_nm = 690;
inline constexpr int k_probes = 15;

}  // namespace culet
