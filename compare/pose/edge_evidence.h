#pragma once
// The evidence of whole wireframe edges. An edge between facets is straight, so it counts as met
// only where the photograph has a straight edge along most of it. The same edge, shifted alone to
// other places on the stone, shows how often that happens by chance: often on a gem full of
// parallel reflexes, and then it proves little.

#include <opencv2/core/mat.hpp>

#include "compare/pose/edge_search.h"
#include "compare/pose/find_pose.h"

namespace culet {

/// `points` come from `points_along`; `stone`: CV_8U, the photograph's stone; `diameter_px`: its
/// diameter.
CrownEvidence crown_evidence(const EdgePicture& picture, const cv::Mat& stone,
                             const std::vector<WirePoint>& points, double diameter_px);

}  // namespace culet
