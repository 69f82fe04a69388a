#include "fit/model/eigenvector.h"

#include <Eigen/Core>
#include <glm/matrix.hpp>

#include "stone/numbers/dense_algebra.h"

namespace culet {

LeastEigenvector least_eigenvector(const glm::dmat3& symmetric) {
    Eigen::Matrix3d s;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) s(i, j) = symmetric[j][i];
    }
    const SymmetricEigen3 solver = symmetric_eigen3(s);
    LeastEigenvector result;
    const auto column = [&](int k) {
        const Eigen::Vector3d v = solver.vectors.col(k);
        return glm::dvec3{v.x(), v.y(), v.z()};
    };
    result.vector = column(0);
    if (result.vector.z < 0) result.vector = -result.vector;
    const double largest = solver.values(2);
    for (int k = 1; k < 3; ++k) {
        const double gap = solver.values(k) - solver.values(0);
        if (gap > 1e-14 * largest) {
            result.pseudo_inverse += glm::outerProduct(column(k), column(k)) / gap;
        }
    }
    return result;
}

}  // namespace culet
