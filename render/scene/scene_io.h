#pragma once
// Reads scene files (TOML; docs/rendering.md).

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "render/scene/scene.h"
#include "stone/text/toml_file.h"

namespace culet {

/// `stone_instead` and `light_instead` (a preset of light_presets.h) replace the file's stone and
/// lights. Throws InputError with file and line.
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {},
                 const Stone* stone_instead = nullptr, std::string_view light_instead = {});

/// The same for a parsed file.
Scene scene_of(const TomlTable& root, const Stone* stone_instead = nullptr,
               std::string_view light_instead = {});

/// The stone that `stone` or `mesh` names, with the material and axes beside it. Remarks go to
/// `notes`.
Stone scene_stone_of(const TomlTable& root, std::vector<std::string>& notes);

/// Applies the keys beside a stone's file: `name`, `material` and the crystal's axes.
void apply_stone_keys(const TomlTable& table, Stone& stone);

}  // namespace culet
