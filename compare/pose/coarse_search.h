#pragma once
// From a rough view to a handful of views worth refining: every turn of the stone near the start is
// laid over the photograph, sized by its outline and judged by the edges under its wireframe.

#include <vector>

#include "compare/pose/edge_map.h"
#include "compare/pose/outline_shape.h"
#include "compare/pose/wireframe.h"
#include "stone/progress/progress.h"

namespace culet {

struct CoarseView {
    StoneView view;
    double score = 0;  ///< higher is better: log-likelihood, about
};

/// What a wireframe is laid over: one photograph, as it is or mirrored.
struct Target {
    const WireSolid& wire;
    const OutlineShape& shape;
    const EdgeMap& edges;
    double focal_px = 0;  ///< 0: orthographic
    double facet_error = 0;
};

/// The view turned as `start` is, sized and placed by the outline, with its score.
CoarseView score_view(const Target& target, const StoneView& start);

/// Up to `most` views that differ, best first. `angle`: how far the start may be off.
std::vector<CoarseView> search_views(const Target& target, const StoneView& start, double angle,
                                     int most, const Progress& progress);

/// The best views among `view` turned about the stone's z axis, all round, each improved; those
/// that differ from each other, best first.
std::vector<CoarseView> turned_views(const Target& target, const StoneView& view, int most);

}  // namespace culet
