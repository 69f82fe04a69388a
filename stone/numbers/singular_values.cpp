// Part of stone/numbers/dense_algebra.h; a file of its own compiles in parallel.

#include <Eigen/SVD>

#include "stone/numbers/dense_algebra.h"

namespace culet {

SingularValues singular_values(const MatrixView& matrix) {
    const Eigen::JacobiSVD<Eigen::MatrixXd> parts(Eigen::MatrixXd(matrix),
                                                  Eigen::ComputeThinU | Eigen::ComputeThinV);
    return {parts.matrixU(), parts.singularValues(), parts.matrixV()};
}

}  // namespace culet
