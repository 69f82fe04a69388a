#pragma once
// Reads and applies `transform` of scene files.

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
    /// Unit normal, still pointing to the outside.
    Vec3 of_normal(const Vec3& normal) const;
    /// Scale factor of a similarity; 0 if the transform is not one.
    double scale() const;
    bool mirrors() const;
};

/// Reads `transform`: { scale, rotate = [x, y, z] (degrees, about the axes in that order),
/// translate }, applied in this order, or a matrix of 12 or 16 numbers, row by row. The identity if
/// missing. Throws InputError with file and line.
Transform transform_in(const TomlTable& table);

/// Rotation about the x, y and z axis, in this order.
glm::dmat3 rotation_of(const Vec3& degrees);

/// `transform` must be a similarity that does not mirror.
void move_stone(const Transform& transform, Stone& stone);
/// Returns false, without any change, if the shape's type would change (a sphere to an ellipsoid).
bool move_shape(const Transform& transform, Shape& shape);

}  // namespace culet
