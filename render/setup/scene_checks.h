#pragma once
// Checks of a scene before rendering.

#include "render/geometry/stone_body.h"
#include "render/scene/scene.h"

namespace culet {

/// Throws InputError: a stone that is not closed, or not convex as it claims; a camera inside a
/// stone; something inside glass; a depth over the longest path.
void require_renderable(const Scene& scene);
/// The only check that another camera may fail.
void require_outside(const StoneBody& body, const Camera& camera);

/// Notes if corners lie off their planes, so that the drawing differs from the mesh.
std::vector<std::string> notes_on_drawing(const Scene& scene);

}  // namespace culet
