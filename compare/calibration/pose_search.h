#pragma once
// Improves an uncertain pose by finding the view whose render agrees best with the photograph.

#include <vector>

#include "compare/calibration/draft_renderer.h"
#include "compare/pose/stone_view.h"
#include "stone/progress/progress.h"

namespace culet {

struct PoseSearch {
    double reach = 0;  ///< how far off the view may be, radians
    int threads = 0;
};

struct SearchedPose {
    Camera camera;
    double moved = 0;       ///< from the start, radians
    double agreement = -1;  ///< correlation of bright and dark (zncc); -1: not registered
    int drawn = 0;          ///< number of pictures
};

/// Standard uncertainty of a searched view about either axis across the line of sight, radians:
/// about the search's last step. Too small where facets are off by 0.2 degrees: six simulated
/// photographs that then matched were 0.1 to 0.9 degrees off, and three of a step cut 0.2 to 0.7.
constexpr double k_searched_sigma = 0.0017;  // 0.1 degrees

/// Draws views within `reach` of the start on a hexagonal grid, then on ever finer grids around the
/// best. Seeks only the two tilts, because registration finds place, size and turn. Independent of
/// the number of threads. Throws Interrupted.
SearchedPose search_pose(const Photo& photo, const Scene& scene, const DraftRenderer& renderer,
                         const PoseSearch& search, const Progress& progress = {});

}  // namespace culet
