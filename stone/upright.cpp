#include "stone/upright.h"

#include <glm/geometric.hpp>

#include "stone/least_rotation.h"

namespace culet {

Vec3 up_of(const Stone& stone) {
    const int facet = stone.up_facet.empty() ? -1 : find_facet(stone.solid, stone.up_facet);
    return glm::normalize(
        facet >= 0 ? stone.solid.facets[static_cast<std::size_t>(facet)].plane.normal : stone.up);
}

Solid turned_back(Solid upright, const Vec3& up) {
    const Vec3 z{0, 0, 1};
    if (up == z) return upright;
    for (Vec3& v : upright.vertices) v = turned_with(z, up, v);
    for (Facet& f : upright.facets) f.plane.normal = turned_with(z, up, f.plane.normal);
    return upright;
}

Stone standing_upright(const Stone& stone) {
    const Vec3 up = up_of(stone), z{0, 0, 1};
    if (up == z) return stone;
    Stone turned = stone;
    for (Vec3& v : turned.solid.vertices) v = turned_with(up, z, v);
    for (Facet& f : turned.solid.facets) f.plane.normal = turned_with(up, z, f.plane.normal);
    for (Vec3& axis : turned.crystal.axes) axis = turned_with(up, z, axis);
    turned.up_facet.clear();
    turned.up = z;
    return turned;
}

}  // namespace culet
