#pragma once
// The [light] table of a scene file, see docs/rendering.md.

#include <string>
#include <vector>

#include "render/scene/scene.h"
#include "stone/text/toml_file.h"

namespace culet {

/// `notes` receives what was repaired or is doubtful. Throws InputError with file and line.
Lights lights_of(const TomlTable& table, std::vector<std::string>& notes);

}  // namespace culet
