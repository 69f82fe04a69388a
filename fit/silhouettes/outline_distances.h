#pragma once
// Distances of all contours' points from one body, and the weight of each. Private to the room.

#include <span>
#include <vector>

#include "fit/silhouettes/projected_outline.h"
#include "fit/silhouettes/turning_camera.h"

namespace culet {

/// A contour in the body's frame.
struct PlacedContour {
    Vec3 across{1, 0, 0}, along{0, 1, 0};
    double dx = 0, dy = 0;  ///< to be added to its points
    Vec3 nearing{0, 0, 0};  ///< as in `projected_outline`
};
PlacedContour placed(const FlatContour& contour, const FrameMotion& motion);

/// Where outlines were taken from: sets that move as one, or a turntable before one camera.
struct Viewpoints {
    std::vector<FrameMotion> motions;  ///< of the sets, to the frame of the body
    /// Without turns there is none; else one for each contour, whose points are places in the
    /// picture.
    TurningSeries series;

    PlacedContour placed(std::span<const FlatContour> contours, std::size_t contour) const;
};

struct OutlineDistances {
    std::vector<ProjectedOutline> outlines;                       ///< by contour
    std::vector<std::vector<ProjectedOutline::Nearest>> nearest;  ///< by contour and point
};
OutlineDistances outline_distances(std::span<const Vec3> corners,
                                   std::span<const FlatContour> contours, const Viewpoints& from);

/// Robust standard deviation of one set's distances: 1.4826 times the weighted median size.
double robust_scale(const OutlineDistances& distances, std::span<const FlatContour> contours,
                    int set);

/// Of one in 16 000 normal errors the size is more than so many standard deviations.
inline constexpr double k_sure = 4;
/// Hampel's descending weight: 1 within `sure` robust scales, 0 from 1.75 times as many on, linear
/// in between.
struct OutlierRule {
    double sure = k_sure;
    /// A length: distances beyond `sure` scales count by their sign (Huber) up to it, since good
    /// points may lie far off before convergence; 0: none.
    double reach = 0;
};
double inlier_weight(double distance, double scale, const OutlierRule& rule = {});

SilhouetteMisfit misfit_of(const OutlineDistances& distances, std::span<const FlatContour> contours,
                           int set);

}  // namespace culet
