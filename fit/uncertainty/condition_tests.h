#pragma once
// Tests whether conditions hold, given the readings. Private to the room: shows Eigen.

#include <Eigen/Core>

#include "fit/uncertainty/covariance.h"

namespace culet {

/// Combinations of the hard equations, one a row.
using Combinations = FunctionRows;

/// Lagrange multipliers of conditions (gradient + A' multipliers = 0), zero in expectation if these
/// are true. Their covariance is the inverse of that of the released conditions' misses (Aitchison
/// & Silvey 1958; Rao 1948).
struct Multipliers {
    Eigen::VectorXd values;
    Eigen::MatrixXd covariance;
};
/// `without`: the linear model without the conditions; `rows`, `residuals`: their derivatives and
/// misses. Combinations that repeat others or that other hard equations imply get zero.
Multipliers multipliers_of(const Covariance& without, const FunctionRows& rows,
                           const Eigen::VectorXd& residuals);

/// The linear model with only these combinations of its hard equations, for `multipliers_of`;
/// undetermined directions are not separated.
Covariance keeping(const Linearised& linear, const Combinations& kept);

/// What the hard equations alone leave free: rows Z (Z' M Z)^-1 Z' rows', with Z their null space
/// and M the mesh's metric, without the gauge freedom. Empty if it cannot be found.
Eigen::MatrixXd reach_of(const Linearised& linear, const FunctionRows& rows);

struct QuadraticTest {
    double statistic = 0;
    int conditions = 0;  ///< to be tested
    int tested = 0;      ///< of them, that the readings can test: degrees of freedom
    double p = 1;        ///< chance of so large a statistic if all conditions hold
};

/// x' v^-1 x over the directions of `v` with a variance from `least` (below, other conditions make
/// them exact) to `largest`.
QuadraticTest quadratic_test(const Eigen::VectorXd& x, const Eigen::MatrixXd& v, double least,
                             double largest);

}  // namespace culet
