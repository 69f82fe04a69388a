#pragma once
// What a scene must fulfil before the reference renderer takes it.

#include "render/scene.h"

namespace culet {

/// Throws InputError: a stone that is not closed and convex, a camera inside the stone, a depth
/// over the longest path.
void require_renderable(const Scene& scene);

}  // namespace culet
