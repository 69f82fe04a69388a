// How the fitted shape stands: in the frame of the mesh.

#include "fit/model/system.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace culet {

Quantity System::turn_of(const Shape& shape) const {
    Quantity turn;
    if (stone_.azimuth_from_mesh) return turn;
    // Kabsch (1976) about one axis.
    const std::size_t count = solid_.vertices.size();
    Vec3 mean(0), mesh_mean(0);
    for (std::size_t v = 0; v < count; ++v) {
        mean += shape.points[v] / double(count);
        mesh_mean += solid_.vertices[v] / double(count);
    }
    double east = 0, north = 0;
    for (std::size_t v = 0; v < count; ++v) {
        const Vec3 p = shape.points[v] - mean, q = solid_.vertices[v] - mesh_mean;
        east += p.x * q.x + p.y * q.y;
        north += p.x * q.y - p.y * q.x;
    }
    turn.value = std::atan2(north, east) - turn_;
    const double size = east * east + north * north;
    for (std::size_t v = 0; v < count && size > 0; ++v) {
        const Vec3 q = solid_.vertices[v] - mesh_mean;
        turn.add(Quantity::By::point, int(v),
                 Vec3{east * q.y - north * q.x, -east * q.x - north * q.y, 0} / size);
    }
    return turn;
}

System::Pose System::pose_of(const Shape& shape) const {
    Pose pose;
    const std::size_t count = solid_.vertices.size();
    pose.turn = turn_of(shape).value;
    Vec3 mean(0);
    for (std::size_t v = 0; v < count; ++v) mean += shape.points[v] / double(count);
    pose.shift = middle_ - (turn_about_z(pose.turn) * mean) * outward_ * scale_;
    return pose;
}

Vec3 System::outside_point(const Vec3& p, const Pose& pose) const {
    return (turn_about_z(pose.turn) * p) * outward_ * scale_ + pose.shift;
}

Plane System::outside_plane(const Plane& plane, const Pose& pose) const {
    const Vec3 n = glm::normalize((turn_about_z(pose.turn) * plane.normal) * outward_);
    return {n, plane.offset * scale_ + glm::dot(n, pose.shift)};
}

Vec3 System::inside_direction(const Vec3& direction) const {
    return turn_about_z(turn_) * (upright_ * direction);
}

double System::azimuth_zero(const Pose& pose) const {
    return pose.turn;
}

}  // namespace culet
