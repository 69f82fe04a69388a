#pragma once
// What calipers say of how the stone stands about up, when the other readings leave its corners
// where they are but for a covariance. Private to the room: shows Eigen.

#include <Eigen/Core>
#include <vector>

#include "fit/solve/relaxation.h"

namespace culet {

/// What the readings but the calipers leave of the corners, as the stone itself sees them.
struct Corners {
    std::vector<Vec3> places;
    /// Of each corner in `covariance`, x then y; -1: not asked.
    std::vector<Eigen::Index> column;
    Eigen::MatrixXd covariance;
    std::vector<int> touched;  ///< those that have columns, in their order

    double covariance_of(int one, const Vec3& u, int other, const Vec3& v) const {
        const Eigen::Index r = column[std::size_t(one)], c = column[std::size_t(other)];
        return u.x * (covariance(r, c) * v.x + covariance(r, c + 1) * v.y) +
               u.y * (covariance(r + 1, c) * v.x + covariance(r + 1, c + 1) * v.y);
    }
};

/// Corners that a jaw touches where the stone is turned about up by `angle` get their columns.
void number_touched(const std::vector<Relaxation::Caliper>& calipers, double angle,
                    Corners& corners);

struct CaliperMisfit {
    double chi2 = 0;
    Eigen::VectorXd forces;  ///< on the corners: where they move is their covariance times these
};

/// At this turn and up to `around` beside it, with the calipers' jaws where the stone that fits
/// them best is widest: where that changes for ever, the larger of the two.
CaliperMisfit misfit_at(const std::vector<Relaxation::Caliper>& calipers, const Corners& corners,
                        double angle, double around);

}  // namespace culet
