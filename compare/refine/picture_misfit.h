#pragma once
// Where two pictures differ by more than usual.

#include <opencv2/core/mat.hpp>
#include <string>

#include "compare/refine/photograph_evidence.h"

namespace culet {

/// `difference`: CV_32F, photograph minus picture, whose samples are the places. Usual: the median
/// absolute difference.
EvidenceFit picture_misfit(const cv::Mat& difference, const cv::Mat& mask);

/// The facet that the scene's camera sees at a point of its picture; empty: none.
std::string facet_seen_at(const Scene& scene, double x, double y);

}  // namespace culet
