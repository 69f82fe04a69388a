#pragma once
// Reads [film] of scene files (docs/rendering.md).

#include "render/image/film_look.h"
#include "render/scene/scene.h"
#include "stone/text/toml_file.h"

namespace culet {

/// Throws InputError with file and line.
PngLook read_film(const TomlTable& table);

/// Angle of the pixel at the picture's middle, degrees, seen from the camera. A parallel view
/// counts as 20 degrees from top to bottom.
double degrees_per_pixel(const Camera& camera);

}  // namespace culet
