#pragma once
// Inverts large sparse normal equations, as far as needed. Private to the room: shows Eigen.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <optional>

#include "stone/numbers/dense_algebra.h"

namespace culet {

/// rows' rows + hard_weight^2 hard' hard + diag(diagonal). Long rows (volume, means of a whole
/// stone) would fill the matrix and are kept apart.
struct NormalEquations {
    const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows;
    const Eigen::SparseMatrix<double, Eigen::RowMajor>& hard_rows;
    double hard_weight = 1;
    Eigen::VectorXd diagonal;
};

class NormalInverse {
public:
    NormalInverse();
    ~NormalInverse();
    /// False if the matrix is not positive definite.
    bool compute(const NormalEquations& equations);
    /// f' A^-1 f.
    double quadratic(const Eigen::SparseVector<double>& f) const;
    Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

private:
    struct Factors;
    std::unique_ptr<Factors> factors_;
    // Long rows D by Woodbury: A^-1 = A0^-1 - W (1 + D W)^-1 W', W = A0^-1 D'.
    Eigen::MatrixXd wide_;  // W
    std::optional<Cholesky> capacitance_;
};

/// Number of negative eigenvalues, from an unpivoted LDL' (Sylvester's law); 0 if there is none.
int negative_pivots(const NormalEquations& equations);

}  // namespace culet
