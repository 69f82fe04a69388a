#pragma once
// Whether conditions hold, by what readings say of them. Private to the room: shows Eigen.

#include <Eigen/Core>

#include "fit/uncertainty/covariance.h"

namespace culet {

/// Combinations of the hard equations, one a row.
using Combinations = FunctionRows;

/// The force with which the readings pull at conditions that hold (gradient + A' multipliers = 0;
/// its expectation is 0 if they hold in truth), and its covariance: the inverse of the covariance
/// of the misses that would come out if they were let go (Aitchison & Silvey 1958; Rao 1948).
struct Multipliers {
    Eigen::VectorXd values;
    Eigen::MatrixXd covariance;
};
/// `without`: the linear model without the conditions; `rows` and `residuals`: what each of them
/// makes of a step, and what is missing here. Combinations that repeat others, and such that other
/// hard equations hold, have no force.
Multipliers multipliers_of(const Covariance& without, const FunctionRows& rows,
                           const Eigen::VectorXd& residuals);

/// The linear model with only these combinations of its hard equations, for `multipliers_of`: what
/// is open in it is not told apart.
Covariance keeping(const Linearised& linear, const Combinations& kept);

/// What the hard equations alone leave open, whatever was read: rows Z (Z' M Z)^-1 Z' rows' with Z
/// their null space and M the mesh's metric, but for what nothing sees. Empty where it cannot be
/// told.
Eigen::MatrixXd reach_of(const Linearised& linear, const FunctionRows& rows);

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
