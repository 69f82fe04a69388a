#pragma once
// What this build can draw. Every build for use has all effects; bench_stripped compiles the
// renderers once more without any, to measure what they cost a scene that has none of them.

namespace culet {

/// False: isotropic, clear stones in unpolarised light at one wavelength, and nothing else.
#ifdef CULET_WITHOUT_EFFECTS
inline constexpr bool k_has_effects = false;
#else
inline constexpr bool k_has_effects = true;
#endif

}  // namespace culet
