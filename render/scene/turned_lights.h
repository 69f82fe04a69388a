#pragma once
// Rotation of a scene's lights.

#include <glm/mat3x3.hpp>

#include "render/scene/scene.h"

namespace culet {

/// Turns all lights about a point: environment, near and distant ones, and their polarisation.
Lights turned_lights(const Lights& lights, const glm::dmat3& turn, const Vec3& about);

}  // namespace culet
