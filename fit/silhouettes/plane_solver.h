#pragma once
// The linearised least squares of planes against outlines. Private to the room.

#include <Eigen/Core>
#include <vector>

#include "fit/silhouettes/plane_fit.h"

namespace culet {

/// A body during the fit, and the distances of the outlines' points from it.
struct PlaneState {
    std::vector<Plane> planes;
    Viewpoints from;
    PlaneBody body;
    OutlineDistances distances;
};

class PlaneSolver {
public:
    /// Derivatives of one distance, by the few unknowns that matter.
    struct Slopes {
        std::array<int, 24> column{};
        std::array<double, 24> slope{};
        int count = 0;
        void add(int c, double s) {
            column[std::size_t(count)] = c;
            slope[std::size_t(count++)] = s;
        }
    };

    explicit PlaneSolver(const PlaneFitProblem& problem);

    int planes() const { return planes_; }
    /// Unknowns of the sets' motions, or of the camera and the turns.
    int motions() const { return size_ - 3 * planes_; }
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
    /// each plane (two tilts along `tilts_of(normal)`, the offset), then six for each free set; or
    /// the camera's four (axis, roll, elevation, perspective) and a turn for each contour.
    struct Equations {
        Eigen::MatrixXd matrix;
        Eigen::VectorXd gradient;
    };
    Equations equations(const PlaneState& state, const Weights& weights,
                        const std::vector<double>& sigmas, bool with_start) const;
    PlaneState moved(const PlaneState& state, const Eigen::VectorXd& step) const;

private:
    Slopes slopes_in_set(const PlaneState& state, const PlacedContour& place, int set,
                         const ProjectedOutline::Edge& e, int corner) const;
    Slopes slopes_in_series(const PlaneState& state, std::size_t c, const ProjectedOutline::Edge& e,
                            int corner) const;
    void add_contour(const PlaneState& state, std::size_t c, const std::vector<double>& weights,
                     double sigma, Equations& to) const;

    const PlaneFitProblem& problem_;
    int planes_ = 0, size_ = 0;
    std::vector<int> column_of_set_;  // -1: fixed
    int camera_column_ = -1;          // -1: no turntable
};

}  // namespace culet
