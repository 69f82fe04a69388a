#pragma once
// The outline of a convex body along a direction, and distances of points from it. Private to the
// room.

#include <array>
#include <span>
#include <vector>

#include "fit/silhouettes/silhouette.h"

namespace culet {

/// A contour's points by coordinates along two directions perpendicular to the line of sight.
struct FlatContour {
    Vec3 across{1, 0, 0}, along{0, 1, 0};  ///< in the frame of its set
    std::vector<std::array<double, 2>> points;
    std::vector<double> weights;
    double sigma = 0;
    int set = 0;
};
FlatContour flattened(const Contour& contour, int set);

/// A counter-clockwise convex polygon: for each edge to the next corner the outward normal and its
/// offset.
struct ProjectedOutline {
    struct Edge {
        int from = -1, to = -1;  ///< corners of the body
        double nx = 0, ny = 0, offset = 0;
        double tx = 0, begin = 0, length = 0;  ///< position along the edge: tx... of `part_of`
        double ty = 0;
    };
    std::vector<Edge> edges;

    /// The edge with the largest signed distance of a point, and that distance: positive outside
    /// (near a corner: from the edge's line).
    struct Nearest {
        int edge = -1;
        double distance = 0;
    };
    Nearest nearest(double x, double y) const;
    /// Position of the point's foot on an edge: 0 at its beginning, 1 at its end.
    double part_of(const Edge& edge, double x, double y) const;
};

/// Convex hull of the corners projected on across and along, and divided by 1 - nearing . corner
/// (perspective): Andrew's monotone chain (1979).
ProjectedOutline projected_outline(std::span<const Vec3> corners, const Vec3& across,
                                   const Vec3& along, const Vec3& nearing = {0, 0, 0});

}  // namespace culet
