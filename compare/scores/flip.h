#pragma once
// FLIP: the difference that a person sees when flipping between two pictures.

#include "compare/scores/metrics.h"

namespace culet {

/// LDR-FLIP (Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild 2020) of two linear
/// pictures, 1 being white. Per pixel 0 (equal) to 1; symmetric. `pixels_per_degree` 67 is a screen
/// 0.7 m away, the paper's default.
cv::Mat flip_map(const cv::Mat& first, const cv::Mat& second, double pixels_per_degree = 67);
/// Only where `asked` (CV_8U) is not 0; 0 elsewhere.
cv::Mat flip_map(const cv::Mat& first, const cv::Mat& second, const cv::Mat& asked,
                 double pixels_per_degree = 67);

/// The map's mean under the mask; all else is black in both pictures.
ScoreMap flip(const MatchedPictures& pictures);

}  // namespace culet
