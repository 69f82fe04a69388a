#pragma once
// Which facets one ray meets, by the reference's search.

#include <cstdint>
#include <vector>

#include "render/beams/screen_view.h"
#include "render/geometry/convex_body.h"

namespace culet {

/// The facets that the eye ray through `at` meets, the front one first: at most `depth`, and fewer
/// where less than `cut_weight` (mean of s and p) is left. Empty when it misses. `n`: index over
/// the outside's.
void find_facets(const ConvexBody& body, const ScreenView& view, const ScreenPoint& at, double n,
                 int depth, double cut_weight, std::vector<std::uint16_t>& facets);

}  // namespace culet
