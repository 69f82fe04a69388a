#pragma once
// Exposure and tone mapping of a scene's picture.

#include <optional>
#include <string>

#include "render/image/film_look.h"
#include "render/scene/scene.h"

namespace culet {

/// Returns the scene's [film] with its camera's angle of a pixel. `tonemap`, if it is one of
/// `tone_map_names()`, replaces the scene's.
PngLook look_of(const Scene& scene, const std::string& tonemap);

/// Returns the factor on linear light; nothing means `exposure_for_stone` of the picture. `asked`
/// is "auto" (to the stone), a factor above 0, or empty: to the stone for presets that pictures are
/// taken in, 1 for the scene's own lights and instruments. Throws InputError.
std::optional<double> shown_exposure(const std::string& asked, const Scene& scene);

}  // namespace culet
