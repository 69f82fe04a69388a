#include "render/setup/scene_checks.h"

#include <fmt/format.h>

#include "render/geometry/stone_body.h"
#include "render/optics/path.h"
#include "stone/checks.h"
#include "stone/errors.h"

namespace culet {

namespace {

// A hand-made mesh whose corners lie so little off their planes, as a fraction of the diameter, is
// drawn by its planes, and a note says so.
constexpr double k_drawn_by_planes = 0.02;

void require_drawable(const Stone& stone) {
    const std::string name = stone.name.empty() ? "stone" : stone.name;
    for (const Fault& fault : find_faults(stone.solid, {.planarity = k_drawn_by_planes})) {
        switch (fault.kind) {
            case FaultKind::unused_vertex:
            case FaultKind::repeated_name:
            case FaultKind::repeated_plane:
            case FaultKind::missing_facet:
                break;
            // Planes are what is drawn of a convex stone: outlines that rounding bent are no
            // hindrance, see below.
            case FaultKind::not_convex:
                break;
            case FaultKind::self_crossing:
                if (stone.convex) break;
                [[fallthrough]];
            default:
                throw InputError(fmt::format(
                    "{}: {}; culet info lists all that is wrong with a mesh", name, fault.what));
        }
    }
    if (!(volume(stone.solid) > 0)) {
        throw InputError(fmt::format("{}: the mesh encloses no volume: it is flat", name));
    }
    const double size = diameter(stone.solid);
    if (stone.convex) {
        for (const Facet& facet : stone.solid.facets) {
            for (const Vec3& corner : stone.solid.vertices) {
                if (height_above(facet.plane, corner) > k_drawn_by_planes * size) {
                    throw InputError(fmt::format(
                        "{}: a corner stands {:.2g} above the plane of facet {}: the stone "
                        "is not convex; say convex = false if that is meant (a rough "
                        "hand-made mesh: fit it first)",
                        name, height_above(facet.plane, corner), facet.name));
                }
            }
        }
    }
}

}  // namespace

void require_renderable(const Scene& scene) {
    if (scene.has_stone() || !scene.furnished()) require_drawable(scene.stone);
    for (const Stone& stone : scene.more_stones) require_drawable(stone);
    if (scene.settings.depth > PathTrace::k_longest) {
        throw InputError(fmt::format("depth {} is over the longest path, {}", scene.settings.depth,
                                     PathTrace::k_longest));
    }
    if (scene.has_stone())
        require_outside(StoneBody(scene.stone.solid, scene.stone.convex), scene.camera);
    for (const Stone& stone : scene.more_stones)
        require_outside(StoneBody(stone.solid, stone.convex), scene.camera);
}

void require_outside(const StoneBody& body, const Camera& camera) {
    if (body.contains(camera.position))
        throw InputError("the camera is inside the stone: move camera.position out");
}

std::vector<std::string> notes_on_drawing(const Scene& scene) {
    if (!scene.has_stone()) return {};
    const double off = planarity(scene.stone.solid) / diameter(scene.stone.solid);
    if (!(off > k_largest_miss)) return {};
    return {
        fmt::format("{}: corners lie up to {:.2g} of the diameter off their facets' planes: what "
                    "the planes bound is drawn",
                    scene.stone.name, off)};
}

}  // namespace culet
