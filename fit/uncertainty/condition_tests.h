#pragma once
// Tests whether conditions hold, given the readings. Private to the room: shows Eigen.

#include <Eigen/Core>

#include "fit/uncertainty/covariance.h"

namespace culet {

/// Combinations of the hard equations, one a row.
using Combinations = FunctionRows;

/// Lagrange multipliers of conditions that hold (gradient + A' multipliers = 0). Their expectation
/// is 0 if the conditions are true. Their covariance is the inverse of that of the misses if the
/// conditions were released (Aitchison & Silvey 1958; Rao 1948).
struct Multipliers {
    Eigen::VectorXd values;
    Eigen::MatrixXd covariance;
};
/// `without` is the linear model without the conditions. `rows` are the conditions' derivatives,
/// `residuals` their misses here. Multipliers are zero for combinations that repeat others or that
/// other hard equations imply.
Multipliers multipliers_of(const Covariance& without, const FunctionRows& rows,
                           const Eigen::VectorXd& residuals);

/// The linear model with only these combinations of its hard equations, for `multipliers_of`. It
/// does not separate undetermined directions.
Covariance keeping(const Linearised& linear, const Combinations& kept);

/// What the hard equations alone leave free, whatever was read: rows Z (Z' M Z)^-1 Z' rows', with Z
/// their null space and M the mesh's metric, without the gauge freedom. Empty if it cannot be
/// found.
Eigen::MatrixXd reach_of(const Linearised& linear, const FunctionRows& rows);

/// A quadratic test statistic x' V^-1 x in the directions that V determines.
struct QuadraticTest {
    double statistic = 0;
    int conditions = 0;  ///< conditions to be tested
    int tested = 0;      ///< how many of them the readings can test: degrees of freedom
    double p = 1;        ///< chance of so large a statistic if all conditions hold
};

/// Tests deviations `x` with covariance `v`. Directions with a variance above `largest`, or below
/// `least` (other conditions make them exact), are not tested.
QuadraticTest quadratic_test(const Eigen::VectorXd& x, const Eigen::MatrixXd& v, double least,
                             double largest);

}  // namespace culet
