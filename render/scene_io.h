#pragma once
// Scene files (TOML), see docs/rendering.md.

#include <filesystem>
#include <string>
#include <vector>

#include "render/scene.h"

namespace culet {

/// Throws InputError with file and line. `stone_instead`: use this stone rather than the file's
/// own.
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {},
                 const Stone* stone_instead = nullptr);

}  // namespace culet
