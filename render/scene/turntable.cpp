#include "render/scene/turntable.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace culet {

Scene turned(const Scene& scene, double angle) {
    Scene turned = scene;
    Stone& stone = turned.stone;
    const Vec3 middle = centroid(stone.solid);
    const glm::dquat turn = glm::angleAxis(angle, stone.up);
    for (Vec3& vertex : stone.solid.vertices) vertex = middle + turn * (vertex - middle);
    for (Facet& facet : stone.solid.facets) {
        const double from_middle = facet.plane.offset - glm::dot(facet.plane.normal, middle);
        facet.plane.normal = glm::normalize(turn * facet.plane.normal);
        facet.plane.offset = from_middle + glm::dot(facet.plane.normal, middle);
    }
    for (Vec3& axis : stone.crystal.axes) axis = glm::normalize(turn * axis);
    return turned;
}

}  // namespace culet
