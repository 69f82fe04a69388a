// Orthonormal bases of stone/numbers/dense_algebra.h; a file of its own compiles in parallel.

#include <Eigen/QR>
#include <cmath>

#include "stone/numbers/dense_algebra.h"

namespace culet {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

PivotedQr::PivotedQr(const MatrixView& matrix, double threshold) {
    const auto factor = std::make_shared<Eigen::ColPivHouseholderQR<MatrixXd>>(MatrixXd(matrix));
    if (threshold > 0) factor->setThreshold(threshold);
    factor_ = factor;
}

Eigen::Index PivotedQr::rank() const {
    return factor_->rank();
}

double PivotedQr::pivot(Eigen::Index k) const {
    return std::abs(factor_->matrixR()(k, k));
}

MatrixXd PivotedQr::solve(const MatrixView& right) const {
    return factor_->solve(MatrixXd(right));
}

VectorXd PivotedQr::solve_one(const VectorXd& right) const {
    return factor_->solve(right);
}

MatrixXd PivotedQr::first(Eigen::Index columns) const {
    MatrixXd begin = MatrixXd::Identity(factor_->rows(), columns);
    begin.applyOnTheLeft(factor_->householderQ());
    return begin;
}

MatrixXd PivotedQr::last(Eigen::Index columns) const {
    MatrixXd end = MatrixXd::Zero(factor_->rows(), columns);
    end.bottomRows(columns).setIdentity();
    end.applyOnTheLeft(factor_->householderQ());
    return end;
}

VectorXd PivotedQr::along(VectorXd b) const {
    b.applyOnTheLeft(factor_->householderQ().adjoint());
    return b;
}

MatrixXd PivotedQr::inverse_factor() const {
    const Eigen::Index n = factor_->cols();
    MatrixXd inverse = MatrixXd::Identity(n, n);
    factor_->matrixR().topLeftCorner(n, n).triangularView<Eigen::Upper>().solveInPlace(inverse);
    return factor_->colsPermutation() * inverse;
}

MatrixXd completed_basis(const MatrixView& columns) {
    return Eigen::HouseholderQR<MatrixXd>(MatrixXd(columns)).householderQ();
}

VectorXd along_completed_basis(const MatrixView& columns, VectorXd b) {
    const Eigen::HouseholderQR<MatrixXd> qr{MatrixXd(columns)};
    b.applyOnTheLeft(qr.householderQ().adjoint());
    return b;
}

MatrixXd shortest_solution(const MatrixView& a, const MatrixView& b, double threshold) {
    Eigen::CompleteOrthogonalDecomposition<MatrixXd> parts;
    if (threshold > 0) parts.setThreshold(threshold);
    parts.compute(MatrixXd(a));
    return parts.solve(MatrixXd(b));
}

MatrixXd pseudo_inverse(const MatrixView& matrix) {
    return Eigen::CompleteOrthogonalDecomposition<MatrixXd>(MatrixXd(matrix)).pseudoInverse();
}

}  // namespace culet
