#pragma once
// Reads [camera] of scene files (docs/rendering.md).

#include "render/scene/scene.h"
#include "stone/text/toml_file.h"

namespace culet {

/// Missing keys take the defaults of scene.h. Throws InputError with file and line.
Camera read_camera(const TomlTable& table);

/// True if the table places the camera or says how much it sees. Otherwise frame_stone sets the
/// view.
bool names_a_view(const TomlTable& table);

}  // namespace culet
