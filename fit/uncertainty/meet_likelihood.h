#pragma once
// The likelihood of a size of the meets' misses. Private to the room: shows Eigen.

#include <array>

#include "fit/model/fit_model.h"
#include "fit/solve/free_meets.h"
#include "fit/solve/kkt_solver.h"
#include "fit/uncertainty/covariance.h"

namespace culet {

/// For polished facets and girdle facets, in the scale of the fit: `FitModel::group_sigmas`.
using MeetSigmas = std::array<double, 2>;

/// -2 log restricted likelihood (Patterson & Thompson 1971), up to a constant, in the linear model
/// about one shape: log det V + log det A'V^-1 A + r'V^-1 r. The first two terms are the
/// determinant of the saddle system [P A'; A -V].
class MeetLikelihood {
public:
    /// `with_readings` = false: of the meets and the prior alone.
    MeetLikelihood(const FitModel& model, const Finished& at, bool with_readings = true);

    bool has(std::size_t group) const { return present_[group]; }
    /// Infinite if the equations cannot be factored.
    double operator()(const MeetSigmas& sigmas);

private:
    Linearised linear_;
    Eigen::VectorXd stiffness_;
    KktSolver solver_;  // keeps its pattern
    std::array<bool, 2> present_{};
};

}  // namespace culet
