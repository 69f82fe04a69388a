#pragma once
// Checks of a scene before rendering.

#include "render/geometry/stone_body.h"
#include "render/scene/scene.h"

namespace culet {

/// Throws InputError: a stone that is not closed and convex, a camera inside the stone, a depth
/// over the longest path.
void require_renderable(const Scene& scene);
/// The check that another camera can violate: the camera is outside the stone.
void require_outside(const StoneBody& body, const Camera& camera);

/// Notes where the drawing differs from the stone's mesh: corners that lie off their planes.
std::vector<std::string> notes_on_drawing(const Scene& scene);

}  // namespace culet
