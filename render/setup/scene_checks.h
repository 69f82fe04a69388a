#pragma once
// What a scene must fulfil before the reference renderer takes it.

#include "render/geometry/stone_body.h"
#include "render/scene/scene.h"

namespace culet {

/// Throws InputError: a stone that is not closed and convex, a camera inside the stone, a depth
/// over the longest path.
void require_renderable(const Scene& scene);
/// The part of it that another camera can break.
void require_outside(const StoneBody& body, const Camera& camera);

/// What of the stone is not drawn as its mesh has it: corners that lie off their planes.
std::vector<std::string> notes_on_drawing(const Scene& scene);

}  // namespace culet
