#pragma once
// The planes of a convex stone from outlines. Private to the room.
//
// The outline of a convex body along a direction is the convex hull of its corners as they are
// seen, and each corner is where three planes cross. The distances of an outline's points from that
// hull are made least, by damped Gauss-Newton steps (Levenberg 1944, Marquardt 1963) in the planes
// and in the motions of the sets, with analytic derivatives; after each step the planes enclose a
// body anew, so that corners may come and go.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "fit/silhouettes/outline_distances.h"
#include "fit/silhouettes/plane_body.h"

namespace culet {

struct PlaneFitProblem {
    std::vector<FlatContour> contours;
    std::vector<FrameMotion> motions;   ///< of the sets, to the frame of the planes
    std::vector<bool> is_free;          ///< of the sets: the motion is one of the unknowns
    std::vector<double> stated_sigmas;  ///< of the sets; 0: estimated
    std::vector<Plane> start;           ///< planes that no outline tells of stay there,
    std::vector<double> start_tilts;    ///< within these angles
    double width = 1;                   ///< of the stone
    double reach = 0;                   ///< of `inlier_weight`
};

struct PlaneFit {
    std::vector<Plane> planes;
    std::vector<FrameMotion> motions;
    PlaneBody body;
    OutlineDistances distances;
    std::vector<double> scales;  ///< robust_scale of each set
    int steps = 0;
    bool converged = false;
};

/// From these planes, which may be off `problem.start`.
PlaneFit fit_planes(const PlaneFitProblem& problem, const std::vector<Plane>& planes,
                    int most_steps);

/// Of a fit: sigma of each set, as stated or estimated from the residuals: sqrt(sum of weighted
/// squares / (points - parameters)).
struct PlaneInformation {
    std::vector<double> sigmas;
    /// Of all planes, two tilts along `tilts_of(normal)` and an offset each: J' J / sigma^2 and
    /// what the start says, the motions of free sets eliminated (Schur complement).
    Eigen::MatrixXd matrix;
    double chi2 = 0;  ///< of sets whose sigma is stated
    double chi2_dof = 0;
};
PlaneInformation plane_information(const PlaneFitProblem& problem, const PlaneFit& fit);

}  // namespace culet
