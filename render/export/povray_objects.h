#pragma once
// Parts of a POV-Ray scene: numbers, and the objects around the stone.

#include <string>
#include <vector>

#include "render/scene/scene.h"

namespace culet {

/// Swaps y and z: POV-Ray's frame is left-handed with y up.
std::string povray_vector(const Vec3& v);
std::string povray_colour(const Rgb& rgb);

/// One object, with lengths times `scale`. Notes what is lost: only POV-Ray's light_source lights
/// diffuse surfaces, and no light here becomes one; metals reflect as at normal incidence at all
/// angles, without blur.
std::string povray_object(const SceneObject& object, double scale, double immersion,
                          std::vector<std::string>& notes);

}  // namespace culet
