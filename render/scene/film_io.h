#pragma once
// [film] of scene files, see docs/rendering.md.

#include "render/image/film_look.h"
#include "render/scene/scene.h"
#include "stone/text/toml_file.h"

namespace culet {

/// Throws InputError with file and line.
PngLook read_film(const TomlTable& table);

/// The angle of a pixel at the picture's middle for who looks from where the camera stands,
/// degrees; a parallel view, which has none, counts as one of 20 degrees from top to bottom.
double degrees_per_pixel(const Camera& camera);

}  // namespace culet
