#include "render/scene/transform.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <memory>
#include <utility>

#include "stone/numbers/units.h"

namespace culet {

namespace {

// Tolerance for similarities, relative; matrices may be written with few digits.
constexpr double k_alike = 1e-6;

Transform matrix_in(const TomlTable& table) {
    const auto numbers = *table.numbers("transform");
    if (numbers.size() != 12 && numbers.size() != 16) {
        table.fail(
            "transform",
            fmt::format("transform is a matrix of 12 or 16 numbers, row by row, found {}; or "
                        "{{ scale, rotate, translate }}",
                        numbers.size()));
    }
    if (numbers.size() == 16 &&
        (numbers[12] != 0 || numbers[13] != 0 || numbers[14] != 0 || numbers[15] != 1)) {
        table.fail("transform", "the last row of transform must be 0, 0, 0, 1");
    }
    Transform transform;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            transform.linear[column][row] = numbers[static_cast<std::size_t>(4 * row + column)];
        transform.move[row] = numbers[static_cast<std::size_t>(4 * row + 3)];
    }
    return transform;
}

Transform steps_in(const TomlTable& steps) {
    steps.refuse_unknown({"scale", "rotate", "translate"});
    Transform transform;
    if (steps.kind("scale") == TomlTable::Kind::list) {
        const Vec3 scale = *steps.vector("scale");
        for (int k = 0; k < 3; ++k) transform.linear[k][k] = scale[k];
    } else if (const auto scale = steps.number("scale")) {
        transform.linear = glm::dmat3(*scale);
    }
    transform.linear = rotation_of(steps.vector("rotate").value_or(Vec3(0))) * transform.linear;
    transform.move = steps.vector("translate").value_or(Vec3(0));
    return transform;
}

}  // namespace

glm::dmat3 rotation_of(const Vec3& degrees) {
    glm::dmat3 rotation(1.0);
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 about(0);
        about[axis] = 1;
        rotation = glm::mat3_cast(glm::angleAxis(radians(degrees[axis]), about)) * rotation;
    }
    return rotation;
}

Vec3 Transform::of_normal(const Vec3& normal) const {
    const Vec3 turned = glm::transpose(glm::inverse(linear)) * normal;
    return glm::normalize(turned);
}

double Transform::scale() const {
    const double size = std::cbrt(std::abs(glm::determinant(linear)));
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const double wanted = i == j ? size * size : 0;
            if (!(std::abs(glm::dot(linear[i], linear[j]) - wanted) <= k_alike * size * size))
                return 0;
        }
    }
    return size;
}

bool Transform::mirrors() const {
    return glm::determinant(linear) < 0;
}

Transform transform_in(const TomlTable& table) {
    if (!table.has("transform")) return {};
    const Transform transform = table.kind("transform") == TomlTable::Kind::list
                                    ? matrix_in(table)
                                    : steps_in(*table.table("transform"));
    const double volume = std::abs(glm::determinant(transform.linear));
    if (!(volume > 0 && std::isfinite(volume)))
        table.fail("transform", "transform makes things flat, or infinite");
    return transform;
}

namespace {

struct Move {
    const Transform& by;
    double scale;

    bool operator()(SphereShape& sphere) const {
        sphere.center = by.of_point(sphere.center);
        sphere.radius *= scale;
        return scale > 0;
    }
    bool operator()(PlaneShape& plane) const {
        plane.point = by.of_point(plane.point);
        plane.normal = by.of_normal(plane.normal);
        return true;
    }
    bool operator()(DiscShape& disc) const {
        disc.center = by.of_point(disc.center);
        disc.normal = by.of_normal(disc.normal);
        disc.radius *= scale;
        return scale > 0;
    }
    bool operator()(BoxShape& box) const {
        box.center = by.of_point(box.center);
        for (Vec3& axis : box.axes) axis = by.linear * axis / scale;
        box.half *= scale;
        return scale > 0;
    }
    bool operator()(MeshShape& shape) const {
        TriangleMesh moved = *shape.mesh;
        for (Vec3& vertex : moved.vertices) vertex = by.of_point(vertex);
        for (auto& corners : moved.corner_normals) {
            for (Vec3& normal : corners) normal = by.of_normal(normal);
        }
        if (by.mirrors()) {
            for (auto& triangle : moved.triangles) std::swap(triangle[1], triangle[2]);
            for (auto& corners : moved.corner_normals) std::swap(corners[1], corners[2]);
        }
        shape.mesh = std::make_shared<const TriangleMesh>(std::move(moved));
        return true;
    }
};

}  // namespace

bool move_shape(const Transform& transform, Shape& shape) {
    Shape moved = shape;
    if (!std::visit(Move{transform, transform.scale()}, moved)) return false;
    shape = std::move(moved);
    return true;
}

void move_stone(const Transform& transform, Stone& stone) {
    for (Vec3& vertex : stone.solid.vertices) vertex = transform.of_point(vertex);
    for (Facet& facet : stone.solid.facets) {
        const Vec3 on_plane = transform.of_point(facet.plane.offset * facet.plane.normal);
        facet.plane.normal = transform.of_normal(facet.plane.normal);
        facet.plane.offset = glm::dot(facet.plane.normal, on_plane);
    }
    for (Vec3& axis : stone.crystal.axes) axis = glm::normalize(transform.linear * axis);
    stone.up = glm::normalize(transform.linear * stone.up);
}

}  // namespace culet
