#include "compare/pose/moved_edge.h"

#include <glm/geometric.hpp>

#include "stone/solid/perpendicular.h"

namespace culet {

namespace {

/// A changed plane at a point: its normal, the point's depth below it, and their derivatives by the
/// three changes.
struct ChangedPlane {
    Vec3 normal;
    double below = 0;
    std::array<Vec3, 3> normal_by;
    std::array<double, 3> below_by;
};

ChangedPlane changed_plane(const FacetFrame& frame, const Vec3& x, const double* change) {
    const Vec3 arm = x - frame.middle;
    ChangedPlane plane;
    plane.normal_by = {frame.across, frame.along, Vec3(0)};
    plane.below_by = {-glm::dot(frame.across, arm), -glm::dot(frame.along, arm), 1};
    plane.normal = frame.normal + change[0] * frame.across + change[1] * frame.along;
    for (std::size_t k = 0; k < 3; ++k) plane.below += change[k] * plane.below_by[k];
    return plane;
}

}  // namespace

FacetFrame frame_of(const WireSolid& wire, int facet) {
    const auto f = static_cast<std::size_t>(facet);
    FacetFrame frame;
    frame.normal = wire.solid.facets[f].plane.normal;
    frame.across = perpendicular_to(frame.normal);
    frame.along = glm::cross(frame.normal, frame.across);
    frame.middle = wire.facet_middles[f];
    return frame;
}

MovedEdge moved_edge(const FacetFrame& left, const FacetFrame& right, const Vec3& x,
                     const double* left_change, const double* right_change) {
    const ChangedPlane p = changed_plane(left, x, left_change);
    const ChangedPlane q = changed_plane(right, x, right_change);
    // x + s p.normal + t q.normal on both planes:
    //   a s + b t = p.below, b s + d t = q.below
    const double a = glm::dot(p.normal, p.normal), b = glm::dot(p.normal, q.normal),
                 d = glm::dot(q.normal, q.normal);
    const double determinant = a * d - b * b;
    const double s = (d * p.below - b * q.below) / determinant;
    const double t = (a * q.below - b * p.below) / determinant;
    MovedEdge moved{x + s * p.normal + t * q.normal, {}};
    for (std::size_t k = 0; k < 3; ++k) {
        // Both equations, differentiated by a change of their own plane and of the other.
        const double da = 2 * glm::dot(p.normal, p.normal_by[k]);
        const double db = glm::dot(p.normal_by[k], q.normal);
        const double first = p.below_by[k] - da * s - db * t, second = -db * s;
        moved.slopes[k] = s * p.normal_by[k] + (d * first - b * second) / determinant * p.normal +
                          (a * second - b * first) / determinant * q.normal;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const double dd = 2 * glm::dot(q.normal, q.normal_by[k]);
        const double db = glm::dot(q.normal_by[k], p.normal);
        const double first = -db * t, second = q.below_by[k] - dd * t - db * s;
        moved.slopes[3 + k] = t * q.normal_by[k] +
                              (d * first - b * second) / determinant * p.normal +
                              (a * second - b * first) / determinant * q.normal;
    }
    return moved;
}

}  // namespace culet
