#pragma once
// A facet as triangles.

#include <array>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// By ear clipping (Meisters 1975) in the facet's plane: corners - 2 triangles of indices into
/// Solid::vertices, counter-clockwise as the facet. A convex facet comes out as a fan about its
/// first corner; an outline that crosses itself as some triangles.
std::vector<std::array<int, 3>> facet_triangles(const Solid& solid, const Facet& facet);

}  // namespace culet
