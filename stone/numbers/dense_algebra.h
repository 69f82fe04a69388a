#pragma once
// Decompositions and products of dense matrices, compiled once. Eigen's templates cost seconds in
// every file that uses them; whoever includes this pays for <Eigen/Core> only. The one header that
// shows Eigen to all rooms.

#include <Eigen/Core>
#include <memory>

namespace culet {

/// A matrix or a block of one by columns, without a copy. Rows, and expressions, are copied.
using MatrixView = Eigen::Ref<const Eigen::MatrixXd>;

/// A B, A' B, A B'.
Eigen::MatrixXd product(const MatrixView& a, const MatrixView& b);
Eigen::MatrixXd transpose_times(const MatrixView& a, const MatrixView& b);
Eigen::MatrixXd times_transpose(const MatrixView& a, const MatrixView& b);
/// A' B A with symmetric B.
Eigen::MatrixXd seen_through(const MatrixView& a, const MatrixView& b);
/// A - B (B' A): what is left of columns across orthonormal ones.
Eigen::MatrixXd without_span(const MatrixView& a, const MatrixView& orthonormal);
/// U' B with an upper triangular U, whose lower half is not read.
Eigen::MatrixXd upper_transpose_times(const MatrixView& upper, const MatrixView& b);
/// Adds weight A' A to the lower half of a square matrix; its upper half stays.
void add_square(const MatrixView& a, double weight, Eigen::MatrixXd& lower);

/// L L' of a symmetric positive definite matrix, whose lower half is read.
class Cholesky {
public:
    explicit Cholesky(const MatrixView& matrix);
    /// False when the matrix is not positive definite: nothing else may then be asked.
    bool good() const;
    /// The least square on L's diagonal.
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

/// P' L D L' P of a symmetric semidefinite matrix (in practice of many indefinite ones), whose
/// lower half is read, with pivoting.
class PivotedCholesky {
public:
    explicit PivotedCholesky(const MatrixView& matrix);
    /// False when a pivot failed, or the matrix has a negative direction.
    bool is_positive() const;
    const Eigen::VectorXd& pivots() const { return pivots_; }  ///< D
    /// Of a singular matrix zero along pivots that vanish.
    Eigen::MatrixXd solve(const MatrixView& right) const;
    Eigen::VectorXd solve_one(Eigen::VectorXd right) const;
    Eigen::MatrixXd inverse() const;
    /// x' A^-1 x
    double square(const Eigen::VectorXd& x) const;
    /// L' P: the matrix is its transpose times D times it.
    Eigen::MatrixXd root() const;

private:
    std::shared_ptr<const Eigen::LDLT<Eigen::MatrixXd>> factor_;
    Eigen::VectorXd pivots_;
};

/// Eigenvalues in ascending order, and an orthonormal eigenvector for each in the same column. Of a
/// matrix that is not finite neither is what comes out.
struct SymmetricEigen {
    Eigen::VectorXd values;
    Eigen::MatrixXd vectors;
};
/// The lower half is read.
SymmetricEigen symmetric_eigen(const MatrixView& matrix);

struct SymmetricEigen3 {
    Eigen::Vector3d values;
    Eigen::Matrix3d vectors;
};
SymmetricEigen3 symmetric_eigen3(const Eigen::Matrix3d& matrix);

/// Of a general matrix, in no order; exactly real, or in conjugate pairs.
Eigen::Vector4cd eigenvalues4(const Eigen::Matrix4d& matrix);

/// A P = Q R with columns in the order of what is left of them.
class PivotedQr {
public:
    /// A pivot below this part of the largest counts as zero; 0: rounding.
    explicit PivotedQr(const MatrixView& matrix, double threshold = 0);
    Eigen::Index rank() const;
    /// |R(k, k)|, k < min(rows, columns).
    double pivot(Eigen::Index k) const;
    /// Least squares; of a matrix of lower rank zero for the columns that repeat others.
    Eigen::MatrixXd solve(const MatrixView& right) const;
    Eigen::VectorXd solve_one(const Eigen::VectorXd& right) const;
    /// The first columns of Q: orthonormal; `rank()` of them span the matrix's columns.
    Eigen::MatrixXd first(Eigen::Index columns) const;
    /// The last columns of Q.
    Eigen::MatrixXd last(Eigen::Index columns) const;
    /// Q' b.
    Eigen::VectorXd along(Eigen::VectorXd b) const;
    /// P R^-1 = F, so that (A'A)^-1 = F F'. Of a matrix of full column rank.
    Eigen::MatrixXd inverse_factor() const;

private:
    std::shared_ptr<const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>> factor_;
};

/// Q of a QR without pivoting: square; its first columns span those of the matrix (full rank).
Eigen::MatrixXd completed_basis(const MatrixView& columns);
/// Q' b of the same, without making Q.
Eigen::VectorXd along_completed_basis(const MatrixView& columns, Eigen::VectorXd b);

/// The shortest of all least squares solutions, by a complete orthogonal decomposition. Pivots
/// below the threshold times the largest count as zero; 0: rounding.
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
