#pragma once
// What a scene must fulfil before the reference renderer takes it.

#include "render/scene.h"

namespace culet {

/// Throws InputError: a stone that is not closed and convex, a camera inside the stone, a depth
/// over the longest path.
void require_renderable(const Scene& scene);

/// What of the stone is not drawn as its mesh has it: corners that lie off their planes.
std::vector<std::string> notes_on_drawing(const Scene& scene);

}  // namespace culet
