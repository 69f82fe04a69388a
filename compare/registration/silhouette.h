#pragma once
// Finds the stone's outline in a picture, without using what is inside.

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <string>

namespace culet {

struct Silhouette {
    cv::Mat mask;         ///< CV_8U, 255 on the stone; the picture's size
    cv::Point2d centre;   ///< mean position of the mask's pixels
    double diameter = 0;  ///< of the circle of the same area, pixels
    /// Root mean square distance of the outline from that circle, over the diameter: 0.003 for a
    /// 16-gon, 0.05 for a 3:4 oval.
    double out_of_round = 0;
    std::string source;   ///< "mask", "coverage" or "background"
    std::string trouble;  ///< why none was found, for people; empty when found
    std::string warning;  ///< found, but worth checking
    bool found() const { return trouble.empty(); }
};

/// From the file's coverage (CV_32F, 0..1): over one half is stone.
Silhouette silhouette_from_coverage(const cv::Mat& coverage, const std::string& source);

/// Pixels (CV_32FC3, linear) that differ from the background, closed over dark gaps and filled to
/// the convex hull, because otherwise dark facets in a dark box would be lost. The background is a
/// plane in each colour fitted to the picture's border, so light may fall off sideways. The stone
/// must not touch the border.
Silhouette silhouette_from_background(const cv::Mat& colour);

/// Signed distance to the mask's outline, pixels, positive outside (CV_32F), smoothed by one pixel
/// against the mask's staircase.
cv::Mat signed_distance(const cv::Mat& mask);

}  // namespace culet
