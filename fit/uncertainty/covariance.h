#pragma once
// Covariance of the unknowns of a fit under its hard equations, and what no reading holds.
// Private to the room: shows Eigen.
//
// Readings count with their sigma, hard equations hold exactly, and motions of the whole stone that
// nothing sees are left out (inner constraints). Directions that the readings hold less than twice
// as tightly as the mesh is trusted (20 % of its width) are `open`; along them the mesh's own
// uncertainty is reported.
// Two algorithms: dense algebra in a basis of the free directions (exact but for rounding, also for
// uncertainties that span many powers of ten), and for large stones sparse factors of the normal
// equations.

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "fit/model/linear.h"

namespace culet {

/// Stored row by row: what belongs to one unknown or equation lies together.
using DenseRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class Covariance {
public:
    enum class Algorithm { by_size, dense, sparse };
    explicit Covariance(const Linearised& linear, Algorithm algorithm = Algorithm::by_size);
    ~Covariance();

    /// False: the equations could not be factored; every number is then NaN.
    bool usable() const { return usable_; }
    /// Of a function, as far as readings hold it, and the part that comes from open directions.
    double variance(const FunctionRow& function) const;
    double open_variance(const FunctionRow& function) const;
    /// Both parts together.
    double total_variance(const FunctionRow& function) const;
    /// A row for each function, so that products of two rows are their covariance, open directions
    /// included. Nothing for large stones, where there is no such factor.
    std::optional<DenseRows> halves(const std::vector<FunctionRow>& functions) const;
    /// Covariance of a function with every unknown (open directions included when asked).
    Eigen::VectorXd with_all(const FunctionRow& function, bool open) const;
    /// Variance of every soft equation's fitted value, in units of its own: the diagonal of the hat
    /// matrix. Hinges: 0.
    const Eigen::VectorXd& leverages() const { return leverages_; }
    /// One entry of the hat matrix.
    double leverage(Eigen::Index equation, Eigen::Index other) const;
    /// One column of the hat matrix.
    Eigen::VectorXd leverage_column(Eigen::Index equation) const;
    /// Hat matrix times residuals of the soft equations.
    Eigen::VectorXd fitted_part(const Eigen::VectorXd& residuals) const;
    /// s'Hs with H the hat matrix and s zero but at some equations.
    double fitted_square(const std::vector<std::pair<Eigen::Index, double>>& s) const;
    int rank_defect() const { return open_freedoms_; }
    bool is_dense() const { return sparse_ == nullptr; }
    /// Open directions, of length one in the mesh's metric; dense only (else no columns).
    const DenseRows& open() const { return open_; }

private:
    struct Sparse;
    struct FreePart;
    void find_dense(const Linearised& linear);
    bool find_well_held(const Linearised& linear, const FreePart& free);
    bool find_loosely_held(const Linearised& linear, const FreePart& free);
    void find_sparse(const Linearised& linear);

    bool usable_ = false;
    Eigen::SparseMatrix<double, Eigen::RowMajor> rows_;  // soft
    // Dense. The covariance of what is held is held held'; seen: rows * held.
    DenseRows held_, open_, seen_;
    std::unique_ptr<Sparse> sparse_;
    Eigen::VectorXd leverages_;
    int open_freedoms_ = 0;
};

}  // namespace culet
