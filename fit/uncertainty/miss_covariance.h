#pragma once
// By how much conditions would be missed if they were let go, as far as the readings tell. Private
// to the room: shows Eigen.
//
// With Z a basis of what the other hard equations leave free and H = J'J + M / k_unheld_variance in
// it, misses of conditions G have the covariance G Z (Z' H Z)^-1 Z' G'. Its inverse is the
// covariance of the conditions' multipliers while they hold (`Inference::multiplier_covariance`):
// the lower right block of the inverse of [H G'; G 0] is -(G H^-1 G')^-1. Planes that meet leave
// their corners to follow from them, so that Z is sparse, and dense algebra in the planes'
// parameters alone is many times as fast as a solution for each condition.

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <optional>

#include "fit/model/linear.h"

namespace culet {

/// Combinations of the hard equations, one a row.
using Combinations = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// `kept` and `tested` together stand for all hard equations. Nothing where dense algebra would
/// be the slower way or would lose digits: very sharp readings, conditions that nearly follow from
/// others.
std::optional<Eigen::MatrixXd> miss_covariance(const Linearised& linear, const Combinations& kept,
                                               const Combinations& tested);

}  // namespace culet
