#pragma once
// Scenes for other renderers.

#include <filesystem>
#include <string>
#include <vector>

#include "render/scene/stone_scene.h"

namespace culet {

/// True for .pov, .xml (Mitsuba) and .pbrt.
bool is_for_renderers(const std::filesystem::path& out);

/// Writes the files for another renderer; the one that names the others comes last. Returns notes.
/// Throws InputError.
std::vector<std::string> export_scene(const std::filesystem::path& in,
                                      const std::vector<std::string>& overrides,
                                      const StoneScene& choices, const std::filesystem::path& out);

}  // namespace culet
