#pragma once
// Points of all contours against one body, and which of them count. Private to the room.

#include <span>
#include <vector>

#include "fit/silhouettes/projected_outline.h"

namespace culet {

/// A contour as it lies in the body's frame.
struct PlacedContour {
    Vec3 across{1, 0, 0}, along{0, 1, 0};
    double dx = 0, dy = 0;  ///< to be added to its points
};
PlacedContour placed(const FlatContour& contour, const FrameMotion& motion);

struct OutlineDistances {
    std::vector<ProjectedOutline> outlines;                       ///< of each contour
    std::vector<std::vector<ProjectedOutline::Nearest>> nearest;  ///< of each of its points
};
/// `motions`: of the sets.
OutlineDistances outline_distances(std::span<const Vec3> corners,
                                   std::span<const FlatContour> contours,
                                   std::span<const FrameMotion> motions);

/// Standard deviation of the bulk of one set's distances: 1.4826 times their weighted median size,
/// which is sigma of normal errors.
double robust_scale(const OutlineDistances& distances, std::span<const FlatContour> contours,
                    int set);

/// 1 for a distance within `k_sure` scales, 0 from `k_outlier` on, linear in between (Hampel's
/// descending weight): of normal errors one in 16 000 is weighted down. With a `reach` (a length)
/// what is farther off than `k_sure` scales counts by its sign (Huber), and what is beyond reach
/// does not: on the way a good point may lie far off.
double inlier_weight(double distance, double scale, double reach = 0);
inline constexpr double k_sure = 4, k_outlier = 7;

SilhouetteMisfit misfit_of(const OutlineDistances& distances, std::span<const FlatContour> contours,
                           int set);

}  // namespace culet
