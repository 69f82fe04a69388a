#pragma once
// [camera] of scene files, see docs/rendering.md.

#include "render/scene/scene.h"
#include "stone/text/toml_file.h"

namespace culet {

/// Throws InputError with file and line. Where nothing is said, as in scene.h.
Camera read_camera(const TomlTable& table);

/// Whether it says from where, or how much is seen; else the stone is framed (framing.h).
bool names_a_view(const TomlTable& table);

}  // namespace culet
