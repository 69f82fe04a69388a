#pragma once
// What whole edges of a wireframe say for or against it. An edge between facets is straight, so it
// counts as met only where the photograph has a straight edge along most of it; how often that
// happens by chance is seen from the same edge laid elsewhere on the stone, by itself: on a gem
// full of parallel reflexes it happens often, and then it says little.

#include <opencv2/core/mat.hpp>

#include "compare/pose/edge_search.h"
#include "compare/pose/find_pose.h"

namespace culet {

/// `points` from `points_along`; `stone`: CV_8U, the photograph's stone; `diameter_px`: of it.
CrownEvidence crown_evidence(const EdgePicture& picture, const cv::Mat& stone,
                             const std::vector<WirePoint>& points, double diameter_px);

}  // namespace culet
