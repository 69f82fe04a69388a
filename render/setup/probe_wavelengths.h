// Wavelengths at which materials are probed before drawing.
#pragma once

namespace culet {

// Evenly spaced over the eye's response.
inline constexpr double k_first_nm = 410, k_last_nm = 690;
inline constexpr int k_probes = 15;

}  // namespace culet
