#pragma once
// Where the stone is in a picture: its outline, found without looking at what is inside.

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <string>

namespace culet {

struct Silhouette {
    cv::Mat mask;         ///< CV_8U, 255 on the stone; the picture's size
    cv::Point2d centre;   ///< mean position of the mask's pixels
    double diameter = 0;  ///< of the circle of the same area, pixels
    /// Root mean square of the outline's distance from that circle, over the diameter. A 16-gon
    /// has 0.003, a 3:4 oval 0.05.
    double out_of_round = 0;
    std::string source;   ///< "mask", "coverage" or "background"
    std::string trouble;  ///< why there is none, for people; empty when all is well
    std::string warning;  ///< found, but look at it
    bool found() const { return trouble.empty(); }
};

/// From the file's coverage (CV_32F, 0..1): over one half is stone.
Silhouette silhouette_from_coverage(const cv::Mat& coverage, const std::string& source);

/// From the colours (CV_32FC3, linear): whatever differs from the background, which is what the
/// picture's border shows (a plane in each colour, so that a light falling off sideways does no
/// harm), closed over dark gaps and filled up to its convex hull: the outline of a convex stone is
/// convex, and dark facets in a dark box would else be lost. The stone must not touch the border.
Silhouette silhouette_from_background(const cv::Mat& colour);

/// Signed distance to the mask's outline in pixels, positive outside (CV_32F), smoothed by a
/// Gaussian of one pixel so that the stairs of the mask average out.
cv::Mat signed_distance(const cv::Mat& mask);

}  // namespace culet
