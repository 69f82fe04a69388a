#pragma once
// Exposure and tone mapping of a scene's picture.

#include <optional>
#include <string>

#include "render/image/film_look.h"
#include "render/scene/scene.h"

namespace culet {

/// The scene's [film] with its camera's angle of a pixel. `tonemap` replaces the scene's if it is
/// one of `tone_map_names()`.
PngLook look_of(const Scene& scene, const std::string& tonemap);

/// The scene's own look, exposed to the stone in its picture.
PngLook look_for(const Scene& scene, const Picture& picture);

/// Factor on linear light; nothing: `exposure_for_stone` of the picture. `asked`: "auto" (to the
/// stone), a factor above 0, or empty: to the stone for presets that are no instruments, else 1.
/// Throws InputError.
std::optional<double> shown_exposure(const std::string& asked, const Scene& scene);

}  // namespace culet
