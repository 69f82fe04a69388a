#pragma once
// The effects compiled into this build. bench_stripped compiles the renderers without any, to
// measure what they cost scenes that do not use them.

namespace culet {

/// False: only isotropic, clear stones in unpolarised light at one wavelength.
#ifdef CULET_WITHOUT_EFFECTS
inline constexpr bool k_has_effects = false;
#else
inline constexpr bool k_has_effects = true;
#endif

}  // namespace culet
