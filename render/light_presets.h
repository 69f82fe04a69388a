#pragma once
// Lighting models with the trade's names.

#include <optional>
#include <string_view>

#include "render/scene.h"

namespace culet {

/// aset: the Angular Spectrum Evaluation Tool of AGS: by elevation above the girdle plane, green
/// 0-45
///   degrees, red 45-75, blue 75-90 (the viewer's head); dark below.
/// hearts, arrows: the viewer's reflector: light from a ring, a dark eye hole; the hearts view
/// looks at the
///   pavilion, the arrows view at the crown. Red ring 15-80 degrees from the axis.
/// lightbox: a dim room with two windows as near planes, sized by the stone's diameter.
/// daylight: a bright zenith, a paler horizon, a sun of half a degree at 45 degrees.
/// Axis: towards the viewer, +z (hearts: -z). Nothing for an unknown name.
std::optional<Lights> light_preset(std::string_view name, double stone_diameter);

}  // namespace culet
