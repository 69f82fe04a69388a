#pragma once
// A stone's up direction, and how to turn the stone so that it becomes +z.

#include <glm/mat3x3.hpp>
#include <optional>
#include <string>

#include "stone/stone.h"

namespace culet {

/// The least rotation of the unit `up` to +z. Exact for coordinate axes; for -z half a turn about
/// x.
glm::dmat3 turn_upright(const Vec3& up);

/// Turns about the origin.
Solid turned(Solid solid, const glm::dmat3& turn);

/// Turns solid, crystal and up direction by the least rotation. The up facet's normal counts where
/// the stone names one.
Stone standing_upright(const Stone& stone);

/// A unit vector: the up facet's normal where the stone names one.
Vec3 up_of(const Stone& stone);

/// Turns an upright solid into the frame of the stone whose up direction is `up`.
Solid turned_back(Solid upright, const Vec3& up);

/// Radians. Tables of drawings and of real stones are tilted by less; a direction this near to a
/// coordinate axis stands for it.
inline constexpr double k_table_tilt = 5 * 3.14159265358979323846 / 180;

/// The axis within `k_table_tilt` of the unit `direction`, or else `direction` itself.
Vec3 axis_near(const Vec3& direction);

/// For people: +y, -x, ... or the three components.
std::string words_for_direction(const Vec3& direction);

/// Asks for `up` where no facet faces +z as a table does; else empty. For readings that count from
/// up.
std::string question_of_up(const Solid& solid);

/// The normal of the one facet that is a table by the solid's shape. A table lies flat over a
/// girdle in one plane across it, is nearer to it than the other end is, smaller than the girdle's
/// outline, larger than what ends the other side, and over the outline's middle. Nothing where no
/// facet is a table, where facets that face different ways are (cubes, octahedra, rough crystals,
/// briolettes, roses on their flat base, cuts with two tables), and for open surfaces. Lengths play
/// no part.
std::optional<int> table_by_shape(const Solid& solid);

}  // namespace culet
