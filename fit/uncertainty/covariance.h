#pragma once
// What the readings say, together, of any quantities of the fitted stone: the covariance of the
// unknowns of a linear model under its hard equations. Private to the room: shows Eigen.
//
// Readings count with their sigma, hard equations hold exactly, and motions of the whole stone that
// nothing sees are left out (inner constraints). What else no reading holds is `open`, in
// directions of length one in the mesh's metric; along them the mesh's own uncertainty is
// reported (20 % of its width). The rule, at any number of facets: along a direction v with
// J'J v = lambda M v the most moved unknown moves by s of the mesh's own uncertainty of it, and the
// readings leave s / sqrt(lambda) there. Where that is half or more, lambda < 4 s^2, v is open. The
// mesh's errors are not averaged out over its facets: a modeller's have much in common. Of large
// stones all with lambda < 4 are, but no more than unknowns that are left as uncertain.
// Two algorithms: dense algebra in a basis of the free directions (exact but for rounding, also for
// uncertainties that span many powers of ten), and for large stones sparse factors of the normal
// equations.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "fit/model/linear.h"

namespace culet {

/// Stored row by row: what belongs to one unknown or equation lies together.
using DenseRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class Covariance {
public:
    enum class Algorithm { by_size, dense, sparse };
    explicit Covariance(Linearised linear, Algorithm algorithm = Algorithm::by_size);
    ~Covariance();

    const Linearised& linear() const { return linear_; }
    /// False: the equations could not be factored; every number is then NaN.
    bool usable() const { return usable_; }
    /// Of a function, as far as readings hold it, and the part that comes from open directions.
    double variance(const FunctionRow& function) const;
    double open_variance(const FunctionRow& function) const;
    /// Both parts together.
    double total_variance(const FunctionRow& function) const;
    /// Covariance of functions, one a row. Each open direction has `undetermined_variance`.
    Eigen::MatrixXd joint(const FunctionRows& functions) const;
    /// Covariance of a function with every unknown (open directions included when asked).
    Eigen::VectorXd with_all(const FunctionRow& function, bool open) const;
    /// Where the readings would lead from here in the linear model; along open directions nowhere.
    Eigen::VectorXd step() const;
    /// Variance of every soft equation's fitted value, in units of its own: the diagonal of the hat
    /// matrix.
    const Eigen::VectorXd& leverages() const { return leverages_; }
    /// One column of the hat matrix.
    Eigen::VectorXd leverage_column(Eigen::Index equation) const;
    /// Hat matrix times residuals of the soft equations.
    Eigen::VectorXd fitted_part(const Eigen::VectorXd& residuals) const;
    int rank_defect() const { return rank_defect_; }
    /// Open directions; dense only (else no columns).
    const DenseRows& open() const { return open_; }

private:
    struct Sparse;
    struct FreePart;
    void find_dense();
    bool find_well_determined(const FreePart& free);
    bool find_poorly_determined(const FreePart& free);
    void find_sparse();

    Linearised linear_;
    bool usable_ = false;
    // Dense. The covariance of what is held is held held'; seen: rows * held.
    DenseRows held_, seen_;
    DenseRows open_;  // orthonormal in the metric
    std::unique_ptr<Sparse> sparse_;
    Eigen::VectorXd leverages_;
    int rank_defect_ = 0;
};

}  // namespace culet
