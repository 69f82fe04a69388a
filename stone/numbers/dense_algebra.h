#pragma once
// Decompositions and products of dense matrices, compiled once, since Eigen's templates cost
// seconds per file. Includers pay for <Eigen/Core> only. The one header that shows Eigen to other
// folders.

#include <Eigen/Core>
#include <memory>

namespace culet {

/// A matrix, or a block of columns, is not copied; rows and expressions are.
using MatrixView = Eigen::Ref<const Eigen::MatrixXd>;

/// A B, A' B, A B'.
Eigen::MatrixXd product(const MatrixView& a, const MatrixView& b);
Eigen::MatrixXd transpose_times(const MatrixView& a, const MatrixView& b);
Eigen::MatrixXd times_transpose(const MatrixView& a, const MatrixView& b);
/// A' B A with symmetric B.
Eigen::MatrixXd congruence(const MatrixView& a, const MatrixView& b);
/// A - B (B' A): the part of the columns of A that is orthogonal to orthonormal B.
Eigen::MatrixXd orthogonal_part(const MatrixView& a, const MatrixView& orthonormal);
/// U' B with an upper triangular U, whose lower half is not read.
Eigen::MatrixXd upper_transpose_times(const MatrixView& upper, const MatrixView& b);
/// Adds weight A' A to the lower half of a square matrix; the upper half is not changed.
void add_square(const MatrixView& a, double weight, Eigen::MatrixXd& lower);

/// L L' of a symmetric positive definite matrix; reads its lower half.
class Cholesky {
public:
    explicit Cholesky(const MatrixView& matrix);
    /// False when the matrix is not positive definite; the other members must not be used then.
    bool good() const;
    double least_pivot() const;
    Eigen::MatrixXd solve(const MatrixView& right) const;
    Eigen::VectorXd solve_one(Eigen::VectorXd right) const;
    Eigen::MatrixXd inverse() const;
    Eigen::MatrixXd solve_lower(const MatrixView& right) const;     ///< L^-1 B
    Eigen::MatrixXd solve_upper(const MatrixView& right) const;     ///< L'^-1 B
    Eigen::MatrixXd divide_by_upper(const MatrixView& left) const;  ///< A L'^-1

private:
    std::shared_ptr<const Eigen::LLT<Eigen::MatrixXd>> factor_;
};

/// P' L D L' P, with pivoting, of a symmetric semidefinite matrix (in practice of many indefinite
/// ones); reads its lower half.
class PivotedCholesky {
public:
    explicit PivotedCholesky(const MatrixView& matrix);
    /// False when a pivot failed, or the matrix has a negative eigenvalue.
    bool is_positive() const;
    const Eigen::VectorXd& pivots() const { return pivots_; }  ///< D
    /// For a singular matrix the solution is zero along pivots that vanish.
    Eigen::MatrixXd solve(const MatrixView& right) const;
    Eigen::VectorXd solve_one(Eigen::VectorXd right) const;
    Eigen::MatrixXd inverse() const;
    /// x' A^-1 x
    double square(const Eigen::VectorXd& x) const;
    /// R = L' P, so that the matrix is R' D R.
    Eigen::MatrixXd root() const;

private:
    std::shared_ptr<const Eigen::LDLT<Eigen::MatrixXd>> factor_;
    Eigen::VectorXd pivots_;
};

/// Eigenvalues in ascending order, each with an orthonormal eigenvector in the same column. Neither
/// is finite if the matrix is not.
struct SymmetricEigen {
    Eigen::VectorXd values;
    Eigen::MatrixXd vectors;
};
/// Reads the lower half.
SymmetricEigen symmetric_eigen(const MatrixView& matrix);

struct SymmetricEigen3 {
    Eigen::Vector3d values;
    Eigen::Matrix3d vectors;
};
SymmetricEigen3 symmetric_eigen3(const Eigen::Matrix3d& matrix);

/// Eigenvalues of a general matrix, unordered; exactly real, or in conjugate pairs.
Eigen::Vector4cd eigenvalues4(const Eigen::Matrix4d& matrix);

/// A P = Q R; the columns are in the order of their remaining norm.
class PivotedQr {
public:
    /// A pivot below this fraction of the largest counts as zero; 0: rounding.
    explicit PivotedQr(const MatrixView& matrix, double threshold = 0);
    Eigen::Index rank() const;
    double pivot(Eigen::Index k) const;
    /// Least squares; for a rank-deficient matrix zero for the redundant columns.
    Eigen::MatrixXd solve(const MatrixView& right) const;
    Eigen::VectorXd solve_one(const Eigen::VectorXd& right) const;
    /// Orthonormal; the first `rank()` span the matrix's columns.
    Eigen::MatrixXd first(Eigen::Index columns) const;
    Eigen::MatrixXd last(Eigen::Index columns) const;
    Eigen::VectorXd along(Eigen::VectorXd b) const;
    /// F = P R^-1, so that (A'A)^-1 = F F'. The matrix must have full column rank.
    Eigen::MatrixXd inverse_factor() const;

private:
    std::shared_ptr<const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>> factor_;
};

/// Q of a QR without pivoting: square; its first columns span those of the matrix (of full rank).
Eigen::MatrixXd completed_basis(const MatrixView& columns);
/// Q' b of the same, without forming Q.
Eigen::VectorXd along_completed_basis(const MatrixView& columns, Eigen::VectorXd b);

/// The minimum-norm least squares solution, by a complete orthogonal decomposition. Pivots below
/// the threshold times the largest count as zero; 0: rounding.
Eigen::MatrixXd shortest_solution(const MatrixView& a, const MatrixView& b, double threshold = 0);
Eigen::MatrixXd pseudo_inverse(const MatrixView& matrix);

/// U diag(values) V', values in descending order; as many columns as the smaller side.
struct SingularValues {
    Eigen::MatrixXd u;
    Eigen::VectorXd values;
    Eigen::MatrixXd v;
};
SingularValues singular_values(const MatrixView& matrix);

/// By LU; not finite where the matrix is singular.
Eigen::MatrixXd inverse_of(const MatrixView& matrix);
Eigen::Matrix3d inverse3(const Eigen::Matrix3d& matrix);
double determinant3(const Eigen::Matrix3d& matrix);

}  // namespace culet
