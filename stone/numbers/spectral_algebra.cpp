// Part of stone/numbers/dense_algebra.h; a file of its own compiles in parallel.

#include <Eigen/Eigenvalues>

#include "stone/numbers/dense_algebra.h"

namespace culet {

namespace {

using Eigen::MatrixXd;

}  // namespace

SymmetricEigen symmetric_eigen(const MatrixView& matrix) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen{MatrixXd(matrix)};
    return {eigen.eigenvalues(), eigen.eigenvectors()};
}

SymmetricEigen3 symmetric_eigen3(const Eigen::Matrix3d& matrix) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(matrix);
    return {eigen.eigenvalues(), eigen.eigenvectors()};
}

Eigen::Vector4cd eigenvalues4(const Eigen::Matrix4d& matrix) {
    return matrix.eigenvalues();
}

}  // namespace culet
