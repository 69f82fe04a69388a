#include "stone/numbers/dense_algebra.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace culet {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd identity(Eigen::Index size) {
    return MatrixXd::Identity(size, size);
}

}  // namespace

MatrixXd product(const MatrixView& a, const MatrixView& b) {
    return a * b;
}

MatrixXd transpose_times(const MatrixView& a, const MatrixView& b) {
    return a.transpose() * b;
}

MatrixXd times_transpose(const MatrixView& a, const MatrixView& b) {
    return a * b.transpose();
}

MatrixXd congruence(const MatrixView& a, const MatrixView& b) {
    return transpose_times(a, product(b, a));
}

MatrixXd orthogonal_part(const MatrixView& a, const MatrixView& orthonormal) {
    MatrixXd left = a;
    left.noalias() -= orthonormal * transpose_times(orthonormal, a);
    return left;
}

MatrixXd upper_transpose_times(const MatrixView& upper, const MatrixView& b) {
    return upper.triangularView<Eigen::Upper>().transpose() * b;
}

void add_square(const MatrixView& a, double weight, MatrixXd& lower) {
    if (a.rows() > 0) lower.selfadjointView<Eigen::Lower>().rankUpdate(a.transpose(), weight);
}

Cholesky::Cholesky(const MatrixView& matrix)
    : factor_(std::make_shared<const Eigen::LLT<MatrixXd>>(MatrixXd(matrix))) {}

bool Cholesky::good() const {
    return factor_->info() == Eigen::Success;
}

double Cholesky::least_pivot() const {
    return factor_->matrixLLT().diagonal().cwiseAbs2().minCoeff();
}

MatrixXd Cholesky::solve(const MatrixView& right) const {
    MatrixXd x = right;
    factor_->solveInPlace(x);
    return x;
}

VectorXd Cholesky::solve_one(VectorXd right) const {
    factor_->solveInPlace(right);
    return right;
}

MatrixXd Cholesky::inverse() const {
    return solve(identity(factor_->rows()));
}

MatrixXd Cholesky::solve_lower(const MatrixView& right) const {
    MatrixXd x = right;
    factor_->matrixL().solveInPlace(x);
    return x;
}

MatrixXd Cholesky::solve_upper(const MatrixView& right) const {
    MatrixXd x = right;
    factor_->matrixU().solveInPlace(x);
    return x;
}

MatrixXd Cholesky::divide_by_upper(const MatrixView& left) const {
    MatrixXd x = left;
    factor_->matrixU().solveInPlace<Eigen::OnTheRight>(x);
    return x;
}

PivotedCholesky::PivotedCholesky(const MatrixView& matrix)
    : factor_(std::make_shared<const Eigen::LDLT<MatrixXd>>(MatrixXd(matrix))),
      pivots_(factor_->vectorD()) {}

bool PivotedCholesky::is_positive() const {
    return factor_->info() == Eigen::Success && factor_->isPositive();
}

MatrixXd PivotedCholesky::solve(const MatrixView& right) const {
    MatrixXd x = right;
    factor_->solveInPlace(x);
    return x;
}

VectorXd PivotedCholesky::solve_one(VectorXd right) const {
    factor_->solveInPlace(right);
    return right;
}

double PivotedCholesky::square(const VectorXd& x) const {
    return x.dot(solve_one(x));
}

MatrixXd PivotedCholesky::inverse() const {
    return solve(identity(factor_->rows()));
}

MatrixXd PivotedCholesky::root() const {
    // Not U * P: Eigen 3.4 swaps columns in the order of rows.
    const MatrixXd order = factor_->transpositionsP() * identity(factor_->rows());
    return product(factor_->matrixU().toDenseMatrix(), order);
}

MatrixXd inverse_of(const MatrixView& matrix) {
    return Eigen::PartialPivLU<MatrixXd>(MatrixXd(matrix)).inverse();
}

Eigen::Matrix3d inverse3(const Eigen::Matrix3d& matrix) {
    return matrix.inverse();
}

double determinant3(const Eigen::Matrix3d& matrix) {
    return matrix.determinant();
}

}  // namespace culet
