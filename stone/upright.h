#pragma once
// Which way is up, and a stone turned so that its own up direction is +z.

#include <glm/mat3x3.hpp>
#include <optional>
#include <string>

#include "stone/stone.h"

namespace culet {

/// The least rotation that brings the unit `up` to +z: exact where `up` is a coordinate axis, and
/// half a turn about x where it is -z, so that what lies along +x stays there.
glm::dmat3 turn_upright(const Vec3& up);

/// About the origin; `turn` is a rotation.
Solid turned(Solid solid, const glm::dmat3& turn);

/// Turned by the least rotation: solid, crystal and up direction. The up facet's normal counts
/// where the stone names one.
Stone standing_upright(const Stone& stone);

/// Its own up direction, unit: the up facet's normal where it names one.
Vec3 up_of(const Stone& stone);

/// A solid that stands upright, in the frame of the stone whose up direction is `up`.
Solid turned_back(Solid upright, const Vec3& up);

/// Tables of drawings and of real stones are tilted by less than this against the stone's frame: a
/// direction so near to a coordinate axis stands for that axis. Radians.
inline constexpr double k_table_tilt = 5 * 3.14159265358979323846 / 180;

/// The coordinate axis within `k_table_tilt` of the unit `direction`, or else that itself.
Vec3 axis_near(const Vec3& direction);

/// +y, -x, ... or the three components: for people.
std::string words_for_direction(const Vec3& direction);

/// Where no facet faces up (+z) as a table does: a sentence that asks for `up`; else empty. For
/// what counts from up.
std::string question_of_up(const Solid& solid);

/// Up as the solid itself shows it: the normal of the one facet that is a table, which lies flat
/// over a girdle in one plane across it, nearer to the table than to the other end, is smaller than
/// the girdle's outline and larger than what ends the other side, and lies over the outline's
/// middle. Nothing where no facet is, or facets that face different ways are (cubes, octahedra,
/// rough crystals, briolettes, roses on their flat base, cuts with two tables), and for a surface
/// that is open. Lengths play no part.
std::optional<int> table_by_shape(const Solid& solid);

}  // namespace culet
