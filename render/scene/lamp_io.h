#pragma once
// Reads a [[light.lamp]] table of scene files (docs/rendering.md).

#include "render/scene/scene.h"
#include "stone/text/toml_file.h"

namespace culet {

/// All but its polarisation. `unit`: of lengths. Throws InputError with file and line.
LampLight lamp_of(const TomlTable& table, LengthUnit unit);

}  // namespace culet
