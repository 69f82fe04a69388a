// Of stone/numbers/dense_algebra.h singular values, in a file of its own so that all compile side
// by side.

#include <Eigen/SVD>

#include "stone/numbers/dense_algebra.h"

namespace culet {

SingularValues singular_values(const MatrixView& matrix) {
    const Eigen::JacobiSVD<Eigen::MatrixXd> parts(Eigen::MatrixXd(matrix),
                                                  Eigen::ComputeThinU | Eigen::ComputeThinV);
    return {parts.matrixU(), parts.singularValues(), parts.matrixV()};
}

}  // namespace culet
