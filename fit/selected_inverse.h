#pragma once
// Entries of the inverse of a large sparse positive definite matrix, only where its factor has
// entries. Private to the room: shows Eigen.

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

namespace culet {

/// rows' rows + hard_weight^2 hard' hard + diag(diagonal). Rows that touch a great part of the
/// unknowns (volume, means of a whole stone) would fill it: they are kept apart.
struct NormalEquations {
    const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows;
    const Eigen::SparseMatrix<double, Eigen::RowMajor>& hard_rows;
    double hard_weight = 1;
    Eigen::VectorXd diagonal;
};

class SelectedInverse {
public:
    /// False when the matrix is not positive definite.
    bool compute(const NormalEquations& equations);
    /// f' A^-1 f: from entries that are known when all pairs of f's unknowns stand in one equation,
    /// else by one solve.
    double quadratic(const Eigen::SparseVector<double>& f) const;
    /// f' C g.
    double bilinear(const Eigen::SparseVector<double>& f,
                    const Eigen::SparseVector<double>& g) const;
    Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

private:
    double entry(Eigen::Index row, Eigen::Index column) const;  // NaN: not known

    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
    Eigen::SparseMatrix<double> inverse_;  // lower half, permuted, pattern of the factor
    Eigen::VectorXi place_;                // of an unknown in the permuted order
    // Long rows D by Woodbury: A^-1 = A0^-1 - W (1 + D W)^-1 W', W = A0^-1 D'.
    Eigen::MatrixXd wide_;  // W
    Eigen::LLT<Eigen::MatrixXd> capacitance_;
};

/// Of an unpivoted LDL' of the (indefinite) matrix: by Sylvester's law its number of negative
/// eigenvalues.
int negative_pivots(const NormalEquations& equations);

}  // namespace culet
