#include "fit/mesh_roughness.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace culet {

std::optional<MeshRoughness> MeshRoughness::of(const System& system) {
    const Shape& mesh = system.mesh_shape();
    // Of k corners k - 3 show how far they lie off a plane.
    double squares = 0, redundancy = 0;
    for (std::size_t f = 0; f < mesh.normals.size(); ++f) {
        const std::vector<int>& loop = system.mesh_outline()->loops[f];
        for (int corner : loop) {
            const double off =
                glm::dot(mesh.normals[f], mesh.points[std::size_t(corner)]) - mesh.offsets[f];
            squares += off * off;
        }
        redundancy += double(loop.size()) - 3;
    }
    if (!(redundancy > 0)) return std::nullopt;
    return MeshRoughness(system, std::sqrt(squares / redundancy));
}

double MeshRoughness::turn(int facet) const {
    const std::vector<int>& loop = system_->mesh_outline()->loops[std::size_t(facet)];
    const std::vector<Vec3>& points = system_->mesh_shape().points;
    Vec3 mean(0);
    for (int corner : loop) mean += points[std::size_t(corner)] / double(loop.size());
    double spread = 0;
    for (int corner : loop) {
        const Vec3 off = points[std::size_t(corner)] - mean;
        spread += glm::dot(off, off);
    }
    return corner_ / std::sqrt(std::max(1e-12, spread / 2));
}

}  // namespace culet
