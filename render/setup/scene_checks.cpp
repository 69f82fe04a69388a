#include "render/setup/scene_checks.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "render/geometry/stone_body.h"
#include "render/optics/path.h"
#include "stone/numbers/units.h"
#include "stone/solid/checks.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Largest distance of corners from their planes, relative to the diameter, of a mesh drawn by its
// planes (with a note).
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
            // A convex stone is drawn by its planes, so outlines bent by rounding do not matter.
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

bool holds(const Shape& shape, const Vec3& point) {
    if (const auto* sphere = std::get_if<SphereShape>(&shape))
        return glm::length(point - sphere->center) < sphere->radius;
    const auto* box = std::get_if<BoxShape>(&shape);
    if (box == nullptr) return false;
    for (int k = 0; k < 3; ++k) {
        const Vec3& axis = box->axes[static_cast<std::size_t>(k)];
        if (!(std::abs(glm::dot(point - box->center, axis)) < box->half[k])) return false;
    }
    return true;
}

// Stones and eyes inside glass would be drawn as if outside.
void require_nothing_in_glass(const Scene& scene) {
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const SceneObject& object = scene.objects[i];
        if (!std::holds_alternative<DielectricMaterial>(object.material)) continue;
        if (holds(object.shape, scene.camera.position)) {
            throw InputError(fmt::format(
                "the camera is inside object {} of glass: move camera.position out", i));
        }
        const auto require_outside_it = [&](const Stone& stone) {
            for (const Vec3& corner : stone.solid.vertices) {
                if (!holds(object.shape, corner)) continue;
                throw InputError(fmt::format(
                    "{} reaches into object {} of glass: stones are drawn beside glass; "
                    "immersion = {} surrounds all of the scene",
                    stone.name.empty() ? "the stone" : stone.name, i,
                    std::get<DielectricMaterial>(object.material).index));
            }
        };
        require_outside_it(scene.stone);
        for (const Stone& stone : scene.more_stones) require_outside_it(stone);
    }
}

}  // namespace

void require_renderable(const Scene& scene) {
    if (scene.has_stone() || !scene.has_objects()) require_drawable(scene.stone);
    for (const Stone& stone : scene.more_stones) require_drawable(stone);
    require_nothing_in_glass(scene);
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
    if (!scene.has_stone() || !scene.stone.convex) return {};
    const Solid& solid = scene.stone.solid;
    const double off = planarity(solid) / diameter(solid);
    const bool bent = off > k_largest_miss;
    if (!bent && is_convex(solid)) return {};
    const double apart = distance_from_planes_body(solid);
    if (!bent && apart <= k_largest_miss * diameter(solid)) return {};
    return {fmt::format(
        "{}: {}: its planes' body is drawn, up to {:.2g} {} from the mesh", scene.stone.name,
        bent ? fmt::format("corners lie up to {:.2g} of the diameter off their facets' planes", off)
             : "the mesh is not convex and is to be drawn as convex",
        apart, name_of(scene.stone.unit))};
}

}  // namespace culet
