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

/// The largest distance of a corner from the body that the facets' planes bound, which lies within
/// a closed mesh: how far another body is drawn when a stone is drawn as convex. Infinite when the
/// planes bound none.
double distance_from_planes_body(const Solid& solid);

/// What of the stone is not drawn as its mesh has it: corners that lie off their planes.
std::vector<std::string> notes_on_drawing(const Scene& scene);

}  // namespace culet
