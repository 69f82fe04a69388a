#pragma once
// The covariance of large stones. Private to the room: shows Eigen.

#include <Eigen/Core>

#include "fit/uncertainty/covariance.h"
#include "fit/uncertainty/normal_inverse.h"

namespace culet {

/// The factor of the penalised normal equations. Pins (one for each motion) fix the gauge freedom;
/// Baarda's S-transformation gives inner constraints: the covariance is P C P' with P = 1 - G G' M.
struct Covariance::Sparse {
    explicit Sparse(const Linearised& linear);

    /// With one prior, and the gauge fixed by pins.
    struct PinnedInverse {
        NormalInverse inverse;
        Eigen::MatrixXd gauge_solved;  // U = C M G
        Eigen::MatrixXd gauge_part;    // G' M U
    };
    bool compute(PinnedInverse& pinned, double prior) const;
    NormalEquations equations(double prior) const;
    double of(const PinnedInverse& pinned, const FunctionRow& function) const;
    Eigen::VectorXd with_all(const PinnedInverse& pinned, const Eigen::VectorXd& function) const;
    /// Upper limit of unobservable directions: each leaves some unknown half as uncertain as the
    /// mesh.
    double most_open() const;
    /// An unobservable direction of length q has the variance q^2 / (lambda + prior): the two
    /// priors differ there.
    double open_variance(const FunctionRow& function) const;

    const Linearised& linear;
    FunctionRows rows;      ///< capped so that loose directions stay distinguishable
    Eigen::VectorXd sizes;  ///< of the rows
    PinnedInverse tight;    ///< a weak prior: what the readings determine
    PinnedInverse trusted;  ///< the mesh's own uncertainty as prior, if something is open
    bool has_open = false;

private:
    double hard_weight_ = 1;
    Eigen::MatrixXd gauge_;       // G, orthonormal in the metric
    Eigen::MatrixXd gauge_rows_;  // M G
    Eigen::VectorXd pins_;
};

}  // namespace culet
