#pragma once
// Factors of sparse symmetric matrices, compiled once. Private to the room: shows Eigen.

#include <Eigen/SparseCore>
#include <memory>

namespace culet {

/// P' L D L' P of a sparse symmetric matrix, whose lower half is read. It is not pivoted: P only
/// keeps L sparse.
class SparseLdl {
public:
    using Matrix = Eigen::SparseMatrix<double>;
    SparseLdl();
    ~SparseLdl();
    /// Finds P: once for all matrices that have their entries in the same places.
    void analyse(const Matrix& matrix);
    /// False when a pivot is zero: nothing else may then be asked. After `analyse`.
    bool factor(const Matrix& matrix);
    const Eigen::VectorXd& pivots() const;  ///< D
    const Matrix& lower() const;            ///< L, without the ones of its diagonal
    Eigen::VectorXd solve(const Eigen::VectorXd& right) const;
    /// Each column.
    Eigen::MatrixXd solve_all(const Eigen::MatrixXd& right) const;

private:
    struct Factors;
    std::unique_ptr<Factors> factors_;
};

}  // namespace culet
