#pragma once
// How likely meets of a size are. Private to the room: shows Eigen.

#include <array>

#include "fit/model/fit_model.h"
#include "fit/solve/free_meets.h"
#include "fit/solve/kkt_solver.h"
#include "fit/uncertainty/covariance.h"

namespace culet {

/// Of polished facets and of the girdle's, in the scale of the fit: `FitModel::group_sigmas`.
using MeetSigmas = std::array<double, 2>;

/// Twice the negative logarithm of the restricted likelihood (Patterson & Thompson 1971), but for a
/// constant, as a function of the sigmas, in the linear model about one shape: log det V + log det
/// A'V^-1 A + r'V^-1 r, the first two of which are the determinant of the saddle system [P A'; A
/// -V].
class MeetLikelihood {
public:
    /// Without readings: of the meets beside the prior, as if nothing had been read.
    MeetLikelihood(const FitModel& model, const Finished& at, bool with_readings = true);

    bool has(std::size_t group) const { return present_[group]; }
    /// Infinite where the equations cannot be factored.
    double operator()(const MeetSigmas& sigmas);

private:
    Linearised linear_;
    Eigen::VectorXd stiffness_;
    KktSolver solver_;  // keeps its pattern
    std::array<bool, 2> present_{};
};

}  // namespace culet
