#pragma once
// Settings of a study in words.

#include <string>
#include <vector>

#include "compare/study/studied_scene.h"

namespace culet {

/// Equal for settings that draw the same picture: unneeded effects do not count.
std::string key_of(const StudiedScene& studied, const RenderSettings& settings);

/// "beams, 15 wavelengths, depth 8, tolerance 0.01, without dispersion"
std::string words_of(const StudiedScene& studied, const RenderSettings& settings);

/// Effects that these settings switch off and the reference has on.
std::vector<std::string> effects_left_out(const StudiedScene& studied,
                                          const RenderSettings& settings);

}  // namespace culet
