#pragma once
// Reads and writes [render] of scene files (docs/rendering.md).

#include <string>
#include <utility>
#include <vector>

#include "render/scene/scene.h"
#include "stone/text/toml_file.h"

namespace culet {

/// Throws InputError with file and line.
RenderSettings read_settings(const TomlTable& table);

/// The settings that determine the picture (engine, effects, wavelengths, accuracy), as keys of
/// [render] and TOML values, which are JSON too. Reading them gives the same picture.
std::vector<std::pair<std::string, std::string>> written_settings(const RenderSettings& settings);

}  // namespace culet
