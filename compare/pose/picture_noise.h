#pragma once
// Picture noise, and how strong an edge must be to exceed it.

#include <opencv2/core/mat.hpp>

namespace culet {

/// Noise sigma of one channel of a picture (CV_32FC3) under a mask (empty: everywhere): Immerkaer
/// (1996), with the lower quartile instead of the mean, so that edges do not count.
double noise_of(const cv::Mat& picture, const cv::Mat& mask = {});

/// The smallest value of a gradient map that counts as an edge: four times its noise, estimated
/// from the weaker half of the pixels on and around the stone, but at least a step of an 8-bit
/// file.
double least_edge(const cv::Mat& strength, const cv::Mat& stone);

}  // namespace culet
