#pragma once
// FLIP: how much two pictures differ to somebody who flicks between them.

#include "compare/scores/metrics.h"

namespace culet {

/// LDR-FLIP (Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild 2020) of two
/// linear pictures, 1 being white; 0 (equal) to 1 a pixel, symmetric. `pixels_per_degree` 67 is a
/// screen 0.7 m away, the paper's default.
cv::Mat flip_map(const cv::Mat& first, const cv::Mat& second, double pixels_per_degree = 67);
/// Where `asked` (CV_8U) is not 0; 0 elsewhere.
cv::Mat flip_map(const cv::Mat& first, const cv::Mat& second, const cv::Mat& asked,
                 double pixels_per_degree = 67);

/// The map's mean under the mask; everything else is black in both.
ScoreMap flip(const MatchedPictures& pictures);

}  // namespace culet
