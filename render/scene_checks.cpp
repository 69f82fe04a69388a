#include "render/scene_checks.h"

#include <fmt/format.h>

#include "render/convex_body.h"
#include "render/light_paths.h"
#include "stone/checks.h"
#include "stone/errors.h"

namespace culet {

void require_renderable(const Scene& scene) {
    const Stone& stone = scene.stone;
    if (!stone.convex) {
        throw InputError(
            fmt::format("{}: stones that are not convex are not rendered yet", stone.name));
    }
    CheckLimits limits;
    // A hand-made mesh whose corners lie a little off their planes is drawn by its planes.
    limits.planarity = 0.1;
    for (const Fault& fault : find_faults(stone.solid, limits)) {
        switch (fault.kind) {
            case FaultKind::unused_vertex:
            case FaultKind::repeated_name:
            case FaultKind::repeated_plane:
            case FaultKind::missing_facet:
                break;
            default:
                throw InputError(
                    fmt::format("{}: {}; culet info lists all that is wrong with a mesh",
                                stone.name.empty() ? "stone" : stone.name, fault.what));
        }
    }
    if (scene.settings.depth > PathTrace::k_longest) {
        throw InputError(fmt::format("depth {} is over the longest path, {}", scene.settings.depth,
                                     PathTrace::k_longest));
    }
    if (ConvexBody(stone.solid).contains(scene.camera.position)) {
        throw InputError("the camera is inside the stone: move camera.position out");
    }
}

}  // namespace culet
