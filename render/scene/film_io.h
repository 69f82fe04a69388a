#pragma once
// Reads [film] of scene files (docs/rendering.md).

#include "render/image/film_look.h"
#include "render/scene/scene.h"
#include "stone/text/toml_file.h"

namespace culet {

/// Missing keys stay as in `look`. Throws InputError with file and line.
PngLook read_film(const TomlTable& table, PngLook look);

/// Degrees per pixel at the picture's middle, from the camera; a parallel view counts as 20 degrees
/// high.
double degrees_per_pixel(const Camera& camera);

}  // namespace culet
