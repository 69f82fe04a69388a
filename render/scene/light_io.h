#pragma once
// Reads the [light] table of scene files (docs/rendering.md).

#include <string>
#include <vector>

#include "render/scene/scene.h"
#include "stone/text/toml_file.h"

namespace culet {

/// `notes`: repairs and doubts. Throws InputError with file and line.
Lights lights_of(const TomlTable& table, std::vector<std::string>& notes);

}  // namespace culet
