#pragma once
// Factors of sparse symmetric matrices, compiled in one place. Private to the room: shows Eigen.

#include <Eigen/SparseCore>
#include <memory>

namespace culet {

/// P' L D L' P of a sparse symmetric matrix given by its lower half. Without pivoting: P only keeps
/// L sparse.
class SparseLdl {
public:
    using Matrix = Eigen::SparseMatrix<double>;
    SparseLdl();
    ~SparseLdl();
    /// Finds P, once for all matrices with the same sparsity pattern.
    void analyse(const Matrix& matrix);
    /// Call after `analyse`. Returns false when a pivot is zero; the factors are then invalid.
    bool factor(const Matrix& matrix);
    const Eigen::VectorXd& pivots() const;  ///< D
    const Matrix& lower() const;            ///< L, without its unit diagonal
    Eigen::VectorXd solve(const Eigen::VectorXd& right) const;
    Eigen::MatrixXd solve_all(const Eigen::MatrixXd& right) const;

private:
    struct Factors;
    std::unique_ptr<Factors> factors_;
};

}  // namespace culet
