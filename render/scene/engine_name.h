#pragma once
// Engines by name. All of them are listed in render/engines.cpp; those below are the ones that the
// program chooses itself, or asks for by name.

#include <string>
#include <vector>

namespace culet {

inline constexpr const char* k_auto_engine = "auto";  ///< whichever the scene calls for
inline constexpr const char* k_reference_engine = "reference";
inline constexpr const char* k_beam_engine = "beams";
inline constexpr const char* k_preview_engine = "preview";
inline constexpr const char* k_raytable_engine = "raytable";
inline constexpr const char* k_gpu_engine = "gpu";

/// Every name that a scene may give, "auto" first.
std::vector<std::string> engine_names();

}  // namespace culet
