#pragma once
// Pieces of a POV-Ray scene: numbers, and the objects around the stone.

#include <string>
#include <vector>

#include "render/scene/scene.h"

namespace culet {

/// POV-Ray's frame is left-handed with y up: y and z change places.
std::string povray_vector(const Vec3& v);
std::string povray_colour(const Rgb& rgb);

/// One object; lengths times `scale`. What it does not carry is added to `notes`: diffuse surfaces
/// are lit by POV-Ray's light_source alone, which no light here becomes, and metals reflect at all
/// angles what they do at normal incidence, unblurred.
std::string povray_object(const SceneObject& object, double scale, double immersion,
                          std::vector<std::string>& notes);

}  // namespace culet
