#pragma once
// The covariance of any quantities of the fitted stone, from the linear model of the readings under
// its hard equations. Private to the room: shows Eigen.
//
// Readings count with their sigma; hard equations hold exactly; motions of the whole stone that
// nothing sees are left out (inner constraints). Other directions that no reading determines are
// `open`; they have length one in the mesh's metric, and the mesh's own uncertainty is reported
// along them (20 % of its width).
// The rule for unobservable directions: let J'J v = lambda M v, and let s be the largest component
// of v, as a share of the mesh's own uncertainty of that unknown. After the readings, the unknown
// is uncertain by s / sqrt(lambda) of the mesh's uncertainty. If that is half or more (lambda < 4
// s^2), v is open. The largest component counts, and no mean over facets, because a modeller's
// errors have much in common. In large stones all v with lambda < 4 are open, but no more of them
// than there are unknowns that uncertain.
// Two algorithms: dense algebra in a basis of the free directions (exact but for rounding, even if
// uncertainties span many powers of ten), and sparse factors of the normal equations for large
// stones.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "fit/model/linear.h"

namespace culet {

/// Row-major: access is by unknown or equation.
using DenseRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class Covariance {
public:
    enum class Algorithm { by_size, dense, sparse };
    explicit Covariance(Linearised linear, Algorithm algorithm = Algorithm::by_size);
    ~Covariance();

    const Linearised& linear() const { return linear_; }
    /// False if the equations could not be factored; every number is then NaN.
    bool usable() const { return usable_; }
    /// Variance of a function as far as readings determine it, and the part from unobservable
    /// directions.
    double variance(const FunctionRow& function) const;
    double open_variance(const FunctionRow& function) const;
    double total_variance(const FunctionRow& function) const;
    /// Covariance of functions, one a row. Unobservable directions have `undetermined_variance`.
    Eigen::MatrixXd joint(const FunctionRows& functions) const;
    /// Covariance of a function with every unknown; `open` adds the unobservable directions.
    Eigen::VectorXd with_all(const FunctionRow& function, bool open) const;
    /// The readings' step in the linear model, with none along unobservable directions.
    Eigen::VectorXd step() const;
    /// Diagonal of the hat matrix: variance of each soft equation's fitted value in its own units.
    const Eigen::VectorXd& leverages() const { return leverages_; }
    Eigen::VectorXd leverage_column(Eigen::Index equation) const;
    /// Hat matrix times these residuals of the soft equations.
    Eigen::VectorXd fitted_part(const Eigen::VectorXd& residuals) const;
    int rank_defect() const { return rank_defect_; }
    /// Unobservable directions; no columns in the sparse algorithm.
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
    // Dense. The covariance of the determined part is held held'; seen = rows * held.
    DenseRows held_, seen_;
    DenseRows open_;  // orthonormal in the metric
    std::unique_ptr<Sparse> sparse_;
    Eigen::VectorXd leverages_;
    int rank_defect_ = 0;
};

}  // namespace culet
