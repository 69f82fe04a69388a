#pragma once
// Where a thing of a scene file stands: `transform`.

#include <glm/mat3x3.hpp>
#include <string_view>

#include "render/scene/objects.h"
#include "stone/stone.h"
#include "stone/text/toml_file.h"

namespace culet {

/// point -> linear * point + move.
struct Transform {
    glm::dmat3 linear{1.0};
    Vec3 move{0, 0, 0};
    Vec3 of_point(const Vec3& point) const { return linear * point + move; }
    /// Of normals of surfaces: unit, pointing to the side that was outside.
    Vec3 of_normal(const Vec3& normal) const;
    /// That of a similarity (turned, moved, scaled alike along all directions); 0: it is none.
    double scale() const;
    bool mirrors() const;
};

/// `transform` of a table: { scale, rotate = [x, y, z] (degrees, about the axes in that order),
/// translate }, done in this order, or the 12 or 16 numbers of a matrix, row by row. The identity
/// where there is none. Throws InputError with file and line.
Transform transform_in(const TomlTable& table);

/// Turned about the x, y and z axis, in this order, by so many degrees.
glm::dmat3 rotation_of(const Vec3& degrees);

/// The stone as it stands after a similarity that does not mirror.
void move_stone(const Transform& transform, Stone& stone);
/// False, and nothing done: the shape would be another one (a sphere is an ellipsoid).
bool move_shape(const Transform& transform, Shape& shape);

}  // namespace culet
