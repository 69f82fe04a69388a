#include "fit/mesh/roughness.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace culet {

std::optional<MeshRoughness> MeshRoughness::of(const FitModel& model) {
    const Shape& mesh = model.mesh_shape();
    // A facet with k corners has k - 3 redundant ones.
    double squares = 0, redundancy = 0;
    for (std::size_t f = 0; f < mesh.normals.size(); ++f) {
        const std::vector<int>& loop = model.mesh_outline()->loops[f];
        for (int corner : loop) {
            const double off =
                glm::dot(mesh.normals[f], mesh.points[std::size_t(corner)]) - mesh.offsets[f];
            squares += off * off;
        }
        redundancy += double(loop.size()) - 3;
    }
    if (!(redundancy > 0)) return std::nullopt;
    return MeshRoughness(model, std::sqrt(squares / redundancy));
}

double MeshRoughness::tilt(int facet) const {
    const Vec3& n = model_->mesh_shape().normals[std::size_t(facet)];
    // A level facet has no downward direction: take any.
    const Vec3 across =
        std::hypot(n.x, n.y) > 0 ? glm::normalize(Vec3{-n.y, n.x, 0}) : Vec3{1, 0, 0};
    const Vec3 down = glm::cross(n, across);
    double downs = 0, acrosses = 0, both = 0;
    for (const Vec3& off : from_middle(facet)) {
        const double d = glm::dot(off, down), a = glm::dot(off, across);
        downs += d * d;
        acrosses += a * a;
        both += d * a;
    }
    // Standard error of the tilt of a least-squares plane through the corners.
    const double determinant = downs * acrosses - both * both;
    return determinant > 0 ? corner_ * std::sqrt(acrosses / determinant)
                           : std::numeric_limits<double>::infinity();
}

std::vector<Vec3> MeshRoughness::from_middle(int facet) const {
    const std::vector<Vec3>& points = model_->mesh_shape().points;
    std::vector<Vec3> corners;
    Vec3 middle(0);
    for (const int corner : model_->mesh_outline()->loops[std::size_t(facet)]) {
        corners.push_back(points[std::size_t(corner)]);
        middle += corners.back();
    }
    middle /= double(corners.size());
    for (Vec3& corner : corners) corner -= middle;
    return corners;
}

}  // namespace culet
