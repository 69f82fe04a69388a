#pragma once
// `[[object]]` of a scene file, see docs/rendering.md.

#include "render/scene/objects.h"
#include "stone/numbers/units.h"
#include "stone/text/toml_file.h"

namespace culet {

/// In the order of the file. `unit`: of the stone, in which all lengths are counted. Throws
/// InputError with file and line.
std::vector<SceneObject> objects_of(const TomlTable& root, LengthUnit unit);

}  // namespace culet
