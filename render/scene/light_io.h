#pragma once
// Reads the [light] table of scene files (docs/rendering.md).

#include <string>
#include <vector>

#include "render/scene/scene.h"
#include "stone/text/toml_file.h"

namespace culet {

/// `unit`: of lengths, for the openings of lamps. `notes`: repairs and doubts. Throws InputError
/// with file and line.
Lights lights_of(const TomlTable& table, LengthUnit unit, std::vector<std::string>& notes);

}  // namespace culet
