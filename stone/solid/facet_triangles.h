#pragma once
// Cuts a facet into triangles.

#include <array>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// Clips ears (Meisters 1975): corners - 2 triangles of indices into Solid::vertices,
/// counter-clockwise like the facet. A convex facet gives a fan about its first corner; an outline
/// that crosses itself gives arbitrary triangles.
std::vector<std::array<int, 3>> facet_triangles(const Solid& solid, const Facet& facet);

}  // namespace culet
