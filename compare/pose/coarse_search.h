#pragma once
// Finds views worth refining: tries all rotations near a rough view, fits size and place to the
// outline, and scores the photograph's edges under the wireframe.

#include <vector>

#include "compare/pose/edge_map.h"
#include "compare/pose/outline_shape.h"
#include "compare/pose/wireframe.h"
#include "stone/progress/progress.h"

namespace culet {

struct CoarseView {
    StoneView view;
    double score = 0;  ///< approximate log-likelihood, higher is better
};

/// What a wireframe is compared with: a photograph, as it is or mirrored.
struct Target {
    const WireSolid& wire;
    const OutlineShape& shape;
    const EdgeMap& edges;
    double focal_px = 0;  ///< 0: orthographic
    double facet_error = 0;
};

/// Fits size and place to the outline for the rotation of `start`, and scores the view.
CoarseView score_view(const Target& target, const StoneView& start);

/// Up to `most` different views, best first. `angle`: how far off the start may be, radians.
std::vector<CoarseView> search_views(const Target& target, const StoneView& start, double angle,
                                     int most, const Progress& progress);

/// The best different views among `view` turned all round about the stone's z axis and improved,
/// best first.
std::vector<CoarseView> turned_views(const Target& target, const StoneView& view, int most);

}  // namespace culet
