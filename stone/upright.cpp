#include "stone/upright.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "stone/design/proportions.h"
#include "stone/solid/least_rotation.h"

namespace culet {

glm::dmat3 turn_upright(const Vec3& up) {
    const Vec3 z{0, 0, 1};
    if (up == z) return glm::dmat3(1.0);
    if (up == -z) return {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, -1}};
    glm::dmat3 turn(turned_with(up, z, {1, 0, 0}), turned_with(up, z, {0, 1, 0}),
                    turned_with(up, z, {0, 0, 1}));
    // For a coordinate axis the rotation is exact.
    if (std::abs(up.x) + std::abs(up.y) + std::abs(up.z) == 1) {
        for (int k = 0; k < 3; ++k) turn[k] = glm::round(turn[k]);
    }
    return turn;
}

Solid turned(Solid solid, const glm::dmat3& turn) {
    for (Vec3& v : solid.vertices) v = turn * v;
    for (Facet& f : solid.facets) f.plane.normal = turn * f.plane.normal;
    return solid;
}

Vec3 up_of(const Stone& stone) {
    const int facet = stone.up_facet.empty() ? -1 : find_facet(stone.solid, stone.up_facet);
    return glm::normalize(
        facet >= 0 ? stone.solid.facets[static_cast<std::size_t>(facet)].plane.normal : stone.up);
}

Solid turned_back(Solid upright, const Vec3& up) {
    return turned(std::move(upright), glm::transpose(turn_upright(up)));
}

Stone standing_upright(const Stone& stone) {
    const Vec3 up = up_of(stone), z{0, 0, 1};
    if (up == z) return stone;
    const glm::dmat3 turn = turn_upright(up);
    Stone result = stone;
    result.solid = turned(std::move(result.solid), turn);
    for (Vec3& axis : result.crystal.axes) axis = turn * axis;
    result.up_facet.clear();
    result.up = z;
    return result;
}

Vec3 axis_near(const Vec3& direction) {
    for (int k = 0; k < 3; ++k) {
        if (std::abs(direction[k]) < std::cos(k_table_tilt)) continue;
        Vec3 axis(0);
        axis[k] = std::copysign(1.0, direction[k]);
        return axis;
    }
    return direction;
}

std::string question_of_up(const Solid& solid) {
    if (proportions(solid).table_width) return {};
    return "no facet faces up (+z) as a table does, and the shape does not show which way is up: "
           "it stands as the file has it; if that is wrong, say so in a stone file: up = \"NAME\" "
           "of a facet, or up = [x, y, z]";
}

std::string words_for_direction(const Vec3& direction) {
    for (int k = 0; k < 3; ++k) {
        if (std::abs(direction[k]) == 1)
            return fmt::format("{}{}", direction[k] > 0 ? '+' : '-', "xyz"[k]);
    }
    return fmt::format("({:.3f}, {:.3f}, {:.3f})", direction.x, direction.y, direction.z);
}

}  // namespace culet
