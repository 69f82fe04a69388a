#pragma once
// The facets that one ray meets, by the reference's search.

#include <cstdint>
#include <vector>

#include "render/beams/screen_view.h"
#include "render/geometry/convex_body.h"

namespace culet {

/// Finds the facets that the eye ray through `at` meets, front facet first: at most `depth`, fewer
/// if less than `cut_weight` (mean of s and p) is left, none if it misses. `n`: index relative to
/// the outside.
void find_facets(const ConvexBody& body, const ScreenView& view, const ScreenPoint& at, double n,
                 int depth, double cut_weight, std::vector<std::uint16_t>& facets);

}  // namespace culet
