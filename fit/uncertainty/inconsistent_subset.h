#pragma once
// Irreducible inconsistent sets of readings: the rest agree if any one of them is left out. Private
// to the room: shows Eigen.

#include <Eigen/Core>
#include <vector>

#include "fit/model/fit_model.h"

namespace culet {

/// Leaves out as many readings as possible while chi2 of the rest fails at `level`. `matrix` is R
/// of `Residuals`; `owner` is the reading of each equation (-1: a meet or relation of the mesh,
/// never left out). Empty if all readings together pass, or with too many equations.
std::vector<int> disagreeing_readings(const Eigen::VectorXd& residuals, Eigen::MatrixXd matrix,
                                      const std::vector<int>& owner, double level);

/// The same for exact readings, at a shape that minimises their misses: their hard equations and
/// the meets have no common solution. Empty if all have one.
std::vector<int> inconsistent_exact_readings(const FitModel& model, const Shape& shape,
                                             const std::shared_ptr<const Outline>& outline);

}  // namespace culet
