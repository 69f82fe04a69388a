#pragma once
// Reads `[[object]]` of scene files (docs/rendering.md).

#include "render/scene/objects.h"
#include "stone/numbers/units.h"
#include "stone/text/toml_file.h"

namespace culet {

/// Objects in the file's order, lengths in `unit` (the stone's). Throws InputError with file and
/// line.
std::vector<SceneObject> objects_of(const TomlTable& root, LengthUnit unit);

}  // namespace culet
