#pragma once
// Scene files (TOML), see docs/rendering.md.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "render/scene/scene.h"
#include "stone/text/toml_file.h"

namespace culet {

/// Throws InputError with file and line. `stone_instead`: use this stone rather than the file's
/// own; `light_instead`: the name of a preset (light_presets.h), rather than the file's lights.
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {},
                 const Stone* stone_instead = nullptr, std::string_view light_instead = {});

/// The same of a parsed file.
Scene scene_of(const TomlTable& root, const Stone* stone_instead = nullptr,
               std::string_view light_instead = {});

/// What `stone` or `mesh` of a scene name, with the material and axes beside them. What there is to
/// say about it is added to `notes`.
Stone scene_stone_of(const TomlTable& root, std::vector<std::string>& notes);

/// What a scene says of its stone beside the stone's file: `name`, `material` and the crystal's
/// axes.
void apply_words_beside(const TomlTable& table, Stone& stone);

}  // namespace culet
