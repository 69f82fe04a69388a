#include "fit/model/sparse_ldl.h"

#include <Eigen/SparseCholesky>

#include "stone/progress/check_stop.h"

namespace culet {

struct SparseLdl::Factors {
    Eigen::SimplicialLDLT<Matrix> simplicial;
    Eigen::VectorXd pivots;
};

SparseLdl::SparseLdl() : factors_(std::make_unique<Factors>()) {}

SparseLdl::~SparseLdl() = default;

void SparseLdl::analyse(const Matrix& matrix) {
    check_stop();
    factors_->simplicial.analyzePattern(matrix);
}

bool SparseLdl::factor(const Matrix& matrix) {
    check_stop();
    factors_->simplicial.factorize(matrix);
    if (factors_->simplicial.info() != Eigen::Success) return false;
    factors_->pivots = factors_->simplicial.vectorD();
    return true;
}

const Eigen::VectorXd& SparseLdl::pivots() const {
    return factors_->pivots;
}

const SparseLdl::Matrix& SparseLdl::lower() const {
    return factors_->simplicial.matrixL().nestedExpression();
}

Eigen::VectorXd SparseLdl::solve(const Eigen::VectorXd& right) const {
    check_stop();
    return factors_->simplicial.solve(right);
}

Eigen::MatrixXd SparseLdl::solve_all(const Eigen::MatrixXd& right) const {
    return factors_->simplicial.solve(right);
}

}  // namespace culet
