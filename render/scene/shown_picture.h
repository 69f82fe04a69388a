#pragma once
// How a scene's picture is looked at, where nobody or somebody says more than the scene.

#include <optional>
#include <string>

#include "render/image/film_look.h"
#include "render/scene/scene.h"

namespace culet {

/// The scene's [film], with the angle of a pixel from its camera. `tonemap`: a name of
/// `tone_map_names()`; others, and none, leave the scene's.
PngLook look_of(const Scene& scene, const std::string& tonemap);

/// The factor on linear light; nothing: to the stone, `exposure_for_stone` of the picture.
/// `asked`: "auto" (to the stone), a factor above 0, or empty: to the stone in a light that
/// pictures are taken in, and 1 where the scene's own lights or an instrument's are shown. Throws
/// InputError.
std::optional<double> shown_exposure(const std::string& asked, const Scene& scene);

}  // namespace culet
