#pragma once
// How strong an edge must be to be more than noise.

#include <opencv2/core/mat.hpp>

namespace culet {

/// Noise of one colour of a picture (CV_32FC3) under a mask (empty: everywhere), one sigma:
/// Immerkaer (1996), by the lower quartile instead of the mean, so that edges do not count.
double noise_of(const cv::Mat& picture, const cv::Mat& mask = {});

/// The least of a map of gradient strengths that counts as an edge: four times its own noise, which
/// the weaker half of the pixels around and on the stone shows, and never less than a step of an
/// 8-bit file.
double least_edge(const cv::Mat& strength, const cv::Mat& stone);

}  // namespace culet
