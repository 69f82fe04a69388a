#pragma once
// What the readings say, together, of any quantities of the fitted stone and of the conditions that
// it was held to: the linear model about the end of a fit. Private to the room: shows Eigen.
//
// Everything is in the scale of the fit. A freedom that no reading holds has a variance of
// `k_unheld_variance` in the mesh's metric (`Linearised::metric`): so much more than anything that
// is measured that it takes no part in any test.

#include <Eigen/Dense>
#include <memory>
#include <vector>

#include "fit/model/linear.h"
#include "fit/solve/kkt_solver.h"

namespace culet {

inline constexpr double k_unheld_variance = 1e3;

class Inference {
public:
    /// `held` are further hard equations that the fit ended on.
    Inference(const System& system, const Shape& shape,
              const std::shared_ptr<const Outline>& outline,
              const std::vector<Equation>& held = {});
    /// False when the equations cannot be factored; nothing else may then be asked.
    bool usable() const { return usable_; }

    const Linearised& linear() const { return linear_; }
    /// Rows of small steps of the unknowns, one for each quantity.
    Eigen::MatrixXd rows_of(const std::vector<Quantity>& quantities) const;
    /// Covariance of the errors of all the unknowns times the columns of `rows` transposed.
    Eigen::MatrixXd times_covariance(const Eigen::MatrixXd& rows) const;
    /// rows C rows': symmetric. Costs one sparse solve a row.
    Eigen::MatrixXd covariance(const Eigen::MatrixXd& rows) const;
    /// Of each quantity alone, some at a time: room for a few of them only.
    std::vector<double> sigmas(const std::vector<Quantity>& quantities) const;

    /// What the hard equations alone leave open, whatever was read: rows Z (Z' M Z)^-1 Z' rows'
    /// with Z their null space and M the mesh's metric.
    Eigen::MatrixXd reach(const Eigen::MatrixXd& rows) const;

    /// The force with which the readings pull at each hard equation (in the order of
    /// `linear().hard`): gradient + A' multipliers = 0. If the condition holds in truth,
    /// its expectation is 0.
    const Eigen::VectorXd& multipliers() const { return multipliers_; }
    /// Covariance of combinations of multipliers (columns), if all conditions hold in truth. Its
    /// inverse is the covariance of the amounts by which the conditions would be missed when let
    /// go, and inverse times multipliers is their estimate (Aitchison & Silvey 1958; Rao 1948).
    Eigen::MatrixXd multiplier_covariance(const Eigen::MatrixXd& combinations) const;

private:
    Linearised linear_;
    RowWriter writer_;
    KktSolver solver_;
    bool usable_ = false;
    Eigen::VectorXd multipliers_;
};

/// A quadratic test statistic x' V^-1 x over the directions that V says anything about.
struct QuadraticTest {
    double statistic = 0;
    int conditions = 0;  ///< asked
    int tested = 0;      ///< of these, that the readings can tell: degrees of freedom
    double p = 1;        ///< chance of so large a statistic if all conditions hold
};

/// Of deviations `x` with covariance `v`: directions with more than `largest` variance are not
/// tested, and neither are those with less than `least` (exact by other conditions).
QuadraticTest quadratic_test(const Eigen::VectorXd& x, const Eigen::MatrixXd& v, double least,
                             double largest);

}  // namespace culet
