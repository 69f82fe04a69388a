#pragma once
// An irreducible set of readings that cannot hold together: without any one of them the rest can.
// Private to the room: shows Eigen.

#include <Eigen/Core>
#include <vector>

#include "fit/model/fit_model.h"

namespace culet {

/// Readings none of which can be left out without the rest agreeing (an irreducible inconsistent
/// set), found by leaving out as much as possible while chi2 of the rest still fails at `level`.
/// `matrix` is R of `Residuals`, `owner` the reading of each equation (-1: a meet or relation of
/// the mesh, never left out). Empty when the whole passes, or when there are too many equations.
std::vector<int> disagreeing_readings(const Eigen::VectorXd& residuals, Eigen::MatrixXd matrix,
                                      const std::vector<int>& owner, double level);

/// The same for exact readings, at a shape where they miss by least squares: an irreducible set of
/// readings whose hard equations, together with the meets, have no common solution. Empty when they
/// have one.
std::vector<int> inconsistent_exact_readings(const FitModel& model, const Shape& shape,
                                             const std::shared_ptr<const Outline>& outline);

}  // namespace culet
