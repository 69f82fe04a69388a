#pragma once
// Distances of all contours' points from one body, and the weight of each. Private to the room.

#include <span>
#include <vector>

#include "fit/silhouettes/projected_outline.h"

namespace culet {

/// A contour in the body's frame.
struct PlacedContour {
    Vec3 across{1, 0, 0}, along{0, 1, 0};
    double dx = 0, dy = 0;  ///< to be added to its points
};
PlacedContour placed(const FlatContour& contour, const FrameMotion& motion);

struct OutlineDistances {
    std::vector<ProjectedOutline> outlines;                       ///< by contour
    std::vector<std::vector<ProjectedOutline::Nearest>> nearest;  ///< by contour and point
};
OutlineDistances outline_distances(std::span<const Vec3> corners,
                                   std::span<const FlatContour> contours,
                                   std::span<const FrameMotion> motions);

/// Robust standard deviation of one set's distances: 1.4826 times the weighted median size.
double robust_scale(const OutlineDistances& distances, std::span<const FlatContour> contours,
                    int set);

/// Hampel's descending weight: 1 within `k_sure` scales, 0 from `k_outlier` on, linear in between;
/// one in 16 000 normal errors gets less than 1. With a `reach` (a length), distances beyond
/// `k_sure` scales count by their sign (Huber) up to it: before convergence good points may lie far
/// off.
double inlier_weight(double distance, double scale, double reach = 0);
inline constexpr double k_sure = 4, k_outlier = 7;

SilhouetteMisfit misfit_of(const OutlineDistances& distances, std::span<const FlatContour> contours,
                           int set);

}  // namespace culet
