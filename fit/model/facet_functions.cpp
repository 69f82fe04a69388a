#include "fit/model/facet_functions.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace culet {

std::array<FunctionRow, 3> facet_functions(const Shape& shape, int f, const Layout& layout,
                                           const Vec3& middle) {
    std::array<FunctionRow, 3> rows{FunctionRow(layout.size()), FunctionRow(layout.size()),
                                    FunctionRow(layout.size())};
    const Vec3& n = shape.normals[f];
    const auto basis = tangents(n);
    const double flat = std::hypot(n.x, n.y);
    for (int k = 0; k < 2; ++k) {
        const Vec3& t = basis[static_cast<std::size_t>(k)];
        const Eigen::Index at = layout.tilt(f) + k;
        if (flat > 1e-9) {
            const Vec3 outward{n.x / flat, n.y / flat, 0};
            // inclination = atan2(flat, |z|)
            rows[0].coeffRef(at) =
                std::abs(n.z) * glm::dot(outward, t) - std::copysign(flat, n.z) * t.z;
            rows[1].coeffRef(at) = (n.x * t.y - n.y * t.x) / (flat * flat);
        } else {
            rows[0].coeffRef(at) = 1;
        }
        rows[2].coeffRef(at) = -glm::dot(middle, t);
    }
    rows[2].coeffRef(layout.offset(f)) = 1;
    return rows;
}

Vec3 middle_of(const Shape& shape) {
    Vec3 middle(0);
    for (const Vec3& p : shape.points) middle += p / double(shape.points.size());
    return middle;
}

}  // namespace culet
