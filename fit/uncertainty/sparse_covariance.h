#pragma once
// The covariance of large stones. Private to the room: shows Eigen.

#include <Eigen/Core>

#include "fit/uncertainty/covariance.h"
#include "fit/uncertainty/normal_inverse.h"

namespace culet {

/// The factor of the penalised normal equations. The gauge is held by pins (as many unknowns as
/// motions), and inner constraints follow from them (Baarda's S-transformation): the covariance is
/// P C P' with P = 1 - G G' M.
struct Covariance::Sparse {
    explicit Sparse(const Linearised& linear);

    /// Under one prior, with the gauge held by pins.
    struct PinnedInverse {
        NormalInverse inverse;
        Eigen::MatrixXd gauge_solved;  // U = C M G
        Eigen::MatrixXd gauge_part;    // G' M U
    };
    bool compute(PinnedInverse& pinned, double prior) const;
    NormalEquations equations(double prior) const;
    double of(const PinnedInverse& pinned, const FunctionRow& function) const;
    Eigen::VectorXd with_all(const PinnedInverse& pinned, const Eigen::VectorXd& function) const;
    /// How many directions may be open: each leaves some unknown half as uncertain as the mesh.
    double most_open() const;
    /// An open direction of length q has the variance q^2 / (lambda + prior): what the two priors
    /// disagree on.
    double open_variance(const FunctionRow& function) const;

    const Linearised& linear;
    FunctionRows rows;      ///< no tighter than is told from what is loose
    Eigen::VectorXd sizes;  ///< of the rows
    PinnedInverse tight;    ///< a weak prior: what the readings hold
    PinnedInverse trusted;  ///< the mesh's own trust as prior, where something is open
    bool has_open = false;

private:
    double hard_weight_ = 1;
    Eigen::MatrixXd gauge_;       // G, orthonormal in the metric
    Eigen::MatrixXd gauge_rows_;  // M G
    Eigen::VectorXd pins_;
};

}  // namespace culet
