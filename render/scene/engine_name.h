#pragma once
// Names of engines that the program chooses or asks for itself; render/engines.cpp lists all.

#include <string>
#include <vector>

namespace culet {

inline constexpr const char* k_auto_engine = "auto";  ///< the program chooses
inline constexpr const char* k_reference_engine = "reference";
inline constexpr const char* k_beam_engine = "beams";
inline constexpr const char* k_preview_engine = "preview";
inline constexpr const char* k_raytable_engine = "raytable";
inline constexpr const char* k_gpu_engine = "gpu";

/// All names that a scene may give, "auto" first.
std::vector<std::string> engine_names();

}  // namespace culet
