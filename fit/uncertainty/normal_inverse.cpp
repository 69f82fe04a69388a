#include "fit/uncertainty/normal_inverse.h"

#include <Eigen/SparseCholesky>
#include <vector>

#include "fit/model/sparse_ldl.h"
#include "fit/uncertainty/constants.h"
#include "stone/numbers/dense_algebra.h"
#include "stone/progress/check_stop.h"

namespace culet {

namespace {

using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using Matrix = Eigen::SparseMatrix<double>;

std::vector<Eigen::Index> long_rows(const Rows& rows) {
    std::vector<Eigen::Index> found;
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        if (rows.innerVector(i).nonZeros() > k_cov.long_row) found.push_back(i);
    }
    if (found.size() > k_cov.most_long) found.clear();
    return found;
}

Eigen::MatrixXd dense(const Rows& rows, const std::vector<Eigen::Index>& which) {
    Eigen::MatrixXd result(Eigen::Index(which.size()), rows.cols());
    for (std::size_t i = 0; i < which.size(); ++i) {
        result.row(Eigen::Index(i)) = Eigen::RowVectorXd(rows.row(which[i]));
    }
    return result;
}

Eigen::MatrixXd with_one(Eigen::MatrixXd square) {
    square.diagonal().array() += 1;
    return square;
}

// Without the rows in `apart`.
Matrix normal_matrix(const NormalEquations& equations, const std::vector<Eigen::Index>& apart) {
    Eigen::VectorXd counts = Eigen::VectorXd::Ones(equations.rows.rows());
    for (const Eigen::Index i : apart) counts(i) = 0;
    Rows counted = counts.asDiagonal() * equations.rows;
    counted.prune(0.0);
    const Rows hard = equations.hard_weight * equations.hard_rows;
    Matrix matrix = Matrix(counted.transpose() * counted) + Matrix(hard.transpose() * hard);
    Matrix diagonal(matrix.rows(), matrix.cols());
    diagonal.setIdentity();
    diagonal.diagonal() = equations.diagonal;
    return matrix + diagonal;
}

}  // namespace

struct NormalInverse::Factors : Eigen::SimplicialLLT<Matrix> {};

NormalInverse::NormalInverse() : factors_(std::make_unique<Factors>()) {}

NormalInverse::~NormalInverse() = default;

bool NormalInverse::compute(const NormalEquations& equations) {
    check_stop();
    const std::vector<Eigen::Index> apart = long_rows(equations.rows);
    factors_->compute(normal_matrix(equations, apart));
    if (factors_->info() != Eigen::Success) return false;
    wide_.resize(equations.diagonal.size(), 0);
    if (!apart.empty()) {
        const Eigen::MatrixXd rows = dense(equations.rows, apart);
        wide_ = factors_->solve(rows.transpose());
        capacitance_.emplace(with_one(culet::product(rows, wide_)));
    }
    return true;
}

double NormalInverse::quadratic(const Eigen::SparseVector<double>& f) const {
    check_stop();
    Eigen::VectorXd half = factors_->permutationP() * Eigen::VectorXd(f);
    factors_->matrixL().solveInPlace(half);
    double square = half.squaredNorm();
    if (wide_.cols() > 0) {
        const Eigen::VectorXd along = wide_.transpose() * f;
        square -= capacitance_->solve_lower(along).squaredNorm();
    }
    return square;
}

Eigen::VectorXd NormalInverse::solve(const Eigen::VectorXd& right) const {
    check_stop();
    Eigen::VectorXd solution = factors_->solve(right);
    if (wide_.cols() > 0) {
        solution -= wide_ * capacitance_->solve_one(wide_.transpose() * right);
    }
    return solution;
}

int negative_pivots(const NormalEquations& equations) {
    const std::vector<Eigen::Index> apart = long_rows(equations.rows);
    const Matrix matrix = normal_matrix(equations, apart);
    SparseLdl factors;
    factors.analyse(matrix);
    if (!factors.factor(matrix)) return 0;
    int negative = static_cast<int>((factors.pivots().array() < 0).count());
    if (!apart.empty()) {
        // With borders, [A0, D'; D, -1] has as many more negative eigenvalues as borders; by A0's
        // Schur complement they are those of -(1 + D A0^-1 D').
        const Eigen::MatrixXd rows = dense(equations.rows, apart);
        const Eigen::MatrixXd solved = factors.solve_all(rows.transpose());
        const PivotedCholesky bordered(with_one(culet::product(rows, solved)));
        negative -= static_cast<int>((bordered.pivots().array() < 0).count());
    }
    return negative;
}

}  // namespace culet
