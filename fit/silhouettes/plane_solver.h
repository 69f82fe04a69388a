#pragma once
// The linearised least squares of planes against outlines. Private to the room.

#include <Eigen/Core>
#include <vector>

#include "fit/silhouettes/plane_fit.h"

namespace culet {

/// A body during the fit, and the distances of the outlines' points from it.
struct PlaneState {
    std::vector<Plane> planes;
    std::vector<FrameMotion> motions;
    PlaneBody body;
    OutlineDistances distances;
};

class PlaneSolver {
public:
    explicit PlaneSolver(const PlaneFitProblem& problem);

    int planes() const { return planes_; }
    /// Finds body and distances; false if the planes enclose nothing.
    bool look(PlaneState& state) const;
    /// Robust scale of each set.
    std::vector<double> scales(const PlaneState& state) const;
    using Weights = std::vector<std::vector<double>>;
    /// Weight of each point of each contour.
    Weights weights(const PlaneState& state, const std::vector<double>& scales) const;
    double cost(const PlaneState& state, const Weights& weights,
                const std::vector<double>& sigmas) const;
    /// Half of the cost's Gauss-Newton matrix (lower triangle) and gradient. Unknowns: three for
    /// each plane (two tilts along `tilts_of(normal)`, the offset), then six for each free set.
    struct Equations {
        Eigen::MatrixXd matrix;
        Eigen::VectorXd gradient;
    };
    Equations equations(const PlaneState& state, const Weights& weights,
                        const std::vector<double>& sigmas, bool with_start) const;
    PlaneState moved(const PlaneState& state, const Eigen::VectorXd& step) const;

private:
    void add_contour(const PlaneState& state, std::size_t c, const std::vector<double>& weights,
                     double sigma, Equations& to) const;

    const PlaneFitProblem& problem_;
    int planes_ = 0, size_ = 0;
    std::vector<int> column_of_set_;  // -1: fixed
};

}  // namespace culet
