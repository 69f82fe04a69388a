#pragma once
// Evidence of whole wireframe edges. A straight edge of the stone is met only where the photograph
// has a straight edge along most of it. Shifting the same edge shows how often that happens by
// chance: on a gem full of parallel reflexes often, and then it proves little.

#include <opencv2/core/mat.hpp>

#include "compare/pose/edge_search.h"
#include "compare/pose/find_pose.h"

namespace culet {

/// `points` come from `points_along`. `stone`: CV_8U, the photograph's stone, of `diameter_px`.
CrownEvidence crown_evidence(const EdgePicture& picture, const cv::Mat& stone,
                             const std::vector<WirePoint>& points, double diameter_px);

}  // namespace culet
