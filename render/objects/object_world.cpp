#include "render/objects/object_world.h"

#include <glm/geometric.hpp>
#include <type_traits>

#include "render/objects/shapes.h"

namespace culet {

bool ObjectWorld::PlacedStone::apart_from(const Vec3& origin, const Vec3& direction) const {
    const Vec3 from_center = origin - center;
    const double b = glm::dot(from_center, direction);
    const Vec3 nearest = from_center - b * direction;
    const double outside = glm::dot(from_center, from_center) - radius * radius;
    return glm::dot(nearest, nearest) > radius * radius || (b > 0 && outside > 0);
}

ObjectWorld::ObjectWorld(const Scene& scene)
    : objects_(scene.objects), meshes_(scene.objects), first_stone_(scene.has_stone()) {
    for (std::size_t i = 0; i < objects_.size(); ++i) {
        if (!std::holds_alternative<MeshShape>(objects_[i].shape))
            formulas_.push_back(static_cast<int>(i));
    }
    const auto place = [this](const Stone& stone) {
        const Vec3 center = centroid(stone.solid);
        double radius = 0;
        for (const Vec3& vertex : stone.solid.vertices)
            radius = std::max(radius, glm::length(vertex - center));
        // Vertices at near-miss meets lie off the planes that are drawn.
        const double off = planarity(stone.solid);
        stones_.push_back({StoneBody(stone.solid, stone.convex), center, radius + 2 * off});
    };
    if (first_stone_) place(scene.stone);
    for (const Stone& stone : scene.more_stones) place(stone);
}

WorldHit ObjectWorld::nearest(const Vec3& origin, const Vec3& direction,
                              const RayStart& start) const {
    WorldHit nearest;
    for (const int i : formulas_) {
        const int part = start.object == i ? start.part : -1;
        const auto hit = std::visit(
            [&](const auto& shape) -> std::optional<ShapeHit> {
                if constexpr (std::is_same_v<std::decay_t<decltype(shape)>, MeshShape>) {
                    return std::nullopt;
                } else {
                    return nearest_on(shape, origin, direction, part);
                }
            },
            objects_[static_cast<std::size_t>(i)].shape);
        if (!hit || !(hit->distance < nearest.distance)) continue;
        nearest = {hit->distance, i, -1, hit->part, hit->normal, hit->normal};
    }
    const auto triangle = meshes_.nearest(origin, direction, start.object, start.part);
    if (triangle && triangle->distance < nearest.distance) {
        nearest = {triangle->distance, triangle->object, -1,
                   triangle->triangle, triangle->normal, triangle->shading};
    }
    for (std::size_t i = 0; i < stones_.size(); ++i) {
        const PlacedStone& stone = stones_[i];
        if (start.stone == static_cast<int>(i) || stone.apart_from(origin, direction)) continue;
        const auto entry = stone.body.entry(origin, direction);
        if (!entry || !(entry->distance < nearest.distance)) continue;
        const Vec3& normal = stone.body.normal(entry->facet);
        nearest = {entry->distance, -1, static_cast<int>(i), entry->facet, normal, normal};
    }
    return nearest;
}

Vec3 ObjectWorld::place(const WorldHit& hit, const Vec3& origin, const Vec3& direction) const {
    const Vec3 at = origin + hit.distance * direction;
    if (hit.object < 0) return at;
    return std::visit(
        [&](const auto& shape) -> Vec3 {
            if constexpr (std::is_same_v<std::decay_t<decltype(shape)>, MeshShape>) {
                const TriangleMesh& mesh = *shape.mesh;
                const int corner = mesh.triangles[static_cast<std::size_t>(hit.part)][0];
                const Vec3& in_it = mesh.vertices[static_cast<std::size_t>(corner)];
                return at - glm::dot(hit.normal, at - in_it) * hit.normal;
            } else {
                return on_surface(shape, at, hit.part);
            }
        },
        objects_[static_cast<std::size_t>(hit.object)].shape);
}

}  // namespace culet
