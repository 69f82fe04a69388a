// Second derivatives of the equations, for steps that end fast: without them parameters that the
// readings hold weakly would creep. Those of the readings save no step (bench/corpus_bench.cpp).

#include <glm/geometric.hpp>

#include "fit/solve/relaxation.h"

namespace culet {

std::vector<SymmetricEntry> Relaxation::curvature(const Shape& shape,
                                                  const Eigen::VectorXd& forces) const {
    // force * (normal . point - offset): mixed derivatives of tilts and points, and the turn of the
    // normal itself.
    std::vector<SymmetricEntry> entries;
    const Parameters::TangentBasis tangent_basis = parameters_.tangent_basis(shape);
    for (std::size_t i = 0; i < incidences_.size(); ++i) {
        const Incidence& incidence = system_.incidences()[incidences_[i]];
        const double force = forces(Eigen::Index(i));
        const Parameters::Slots &n = tangent_basis.normals[incidence.facet],
                                &x = tangent_basis.points[incidence.point];
        const double out = glm::dot(shape.normals[incidence.facet], shape.points[incidence.point]);
        for (int a = 0; a < n.count; ++a) {
            entries.push_back({n.column + a, n.column + a, -force * out});
            for (int b = 0; b < x.count; ++b) {
                const int row = std::max(n.column + a, x.column + b),
                          column = std::min(n.column + a, x.column + b);
                entries.push_back(
                    {row, column,
                     force * glm::dot(n.along[std::size_t(a)], x.along[std::size_t(b)])});
            }
        }
    }
    return entries;
}

}  // namespace culet
