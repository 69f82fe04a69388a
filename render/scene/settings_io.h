#pragma once
// [render] of scene files, see docs/rendering.md.

#include <string>
#include <utility>
#include <vector>

#include "render/scene/scene.h"
#include "stone/text/toml_file.h"

namespace culet {

/// Throws InputError with file and line.
RenderSettings read_settings(const TomlTable& table);

/// What decides how a picture is drawn (engine, effects, wavelengths, how finely), as keys of
/// [render] and their values in TOML, which is JSON as well. Read again they give the same picture.
std::vector<std::pair<std::string, std::string>> written_settings(const RenderSettings& settings);

}  // namespace culet
