#pragma once
// A pose that the edges leave unsure, made surer by the stone's own picture: the view from which
// the render agrees best with the photograph.

#include <vector>

#include "compare/calibration/draft_renderer.h"
#include "compare/pose/stone_view.h"
#include "stone/progress/progress.h"

namespace culet {

struct PoseSearch {
    double reach = 0;  ///< radians that the view may be off by
    int threads = 0;
};

struct SearchedPose {
    Camera camera;
    double moved = 0;  ///< radians, from the start
    double agreement =
        -1;         ///< correlation of bright and dark (zncc), -1 where it cannot be laid on
    int drawn = 0;  ///< pictures
};

/// What a view so found is still off by, about either axis across the line of sight: one standard
/// deviation, radians: about the last step of the search. It is too small where facets are off by
/// 0.2 degrees: six simulated photographs that then matched were 0.1 to 0.9 degrees off, and three
/// of a step cut 0.2 to 0.7.
constexpr double k_searched_sigma = 0.0017;  // 0.1 degrees

/// Views within `reach` of the start's are drawn on a hexagonal net, then around the best ever more
/// closely. Only the two tilts of the view are sought: place, size and turn in the picture are the
/// registration's. The same for any number of threads. Throws Interrupted.
SearchedPose search_pose(const Photo& photo, const Scene& scene, const DraftRenderer& renderer,
                         const PoseSearch& search, const Progress& progress = {});

}  // namespace culet
