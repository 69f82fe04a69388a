#pragma once
// Whether two views of a stone look alike except for small irregularities.

#include "compare/pose/wireframe.h"

namespace culet {

/// Whether nearly all of the area seen in the first view belongs to facets with a counterpart of
/// about the same direction and size in the second. `mirrored`: one of the pictures is flipped left
/// to right.
bool look_alike(const WireSolid& wire, const StoneView& a, const StoneView& b, bool mirrored);

/// All rotations about its middle, with and without a reflection, that map the solid onto itself up
/// to rounding error. The first is the identity.
std::vector<glm::dmat3> symmetries_of(const WireSolid& wire);

/// For a stone with the mirror plane y = 0: the rotation from which it looks like the picture from
/// `turn` flipped left to right.
glm::dmat3 mirrored_turn(const glm::dmat3& turn);

}  // namespace culet
