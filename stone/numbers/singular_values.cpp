// The singular values of stone/numbers/dense_algebra.h, in their own file so that they compile in
// parallel.

#include <Eigen/SVD>

#include "stone/numbers/dense_algebra.h"

namespace culet {

SingularValues singular_values(const MatrixView& matrix) {
    const Eigen::JacobiSVD<Eigen::MatrixXd> parts(Eigen::MatrixXd(matrix),
                                                  Eigen::ComputeThinU | Eigen::ComputeThinV);
    return {parts.matrixU(), parts.singularValues(), parts.matrixV()};
}

}  // namespace culet
