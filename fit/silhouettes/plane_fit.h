#pragma once
// Fits the planes of a convex stone to outlines. Private to the room.
//
// An outline is the convex hull of the projected corners, and each corner is the intersection of
// three planes. Damped Gauss-Newton steps (Levenberg 1944, Marquardt 1963) in the planes and the
// sets' motions minimise the points' distances from that hull, with analytic derivatives. After
// each step the body is enclosed anew, so corners may come and go.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "fit/silhouettes/outline_distances.h"
#include "fit/silhouettes/plane_body.h"
#include "fit/silhouettes/plane_condition.h"

namespace culet {

struct PlaneFitProblem {
    std::vector<FlatContour> contours;
    Viewpoints from;                    ///< where the fit starts
    std::vector<bool> is_free;          ///< of the sets: the motion is unknown
    std::vector<double> stated_sigmas;  ///< of the sets; 0: estimated
    std::vector<Plane> start;           ///< planes are held to these with a weak prior
    std::vector<double> start_tilts;    ///< sigma of that prior; radians
    double width = 1;                   ///< of the stone
    OutlierRule outliers;
    ExpectedSeries expected;  ///< of a turntable
    std::vector<PlaneCondition> conditions;
    /// Times a point's sigma, since neighbouring points share errors.
    double shared_errors = 1;
};

struct PlaneFit {
    std::vector<Plane> planes;
    Viewpoints from;
    PlaneBody body;
    OutlineDistances distances;
    std::vector<double> scales;  ///< robust_scale of each set
    int steps = 0;
    bool converged = false;
};

/// Starts from `planes`, which may differ from `problem.start`.
PlaneFit fit_planes(const PlaneFitProblem& problem, const std::vector<Plane>& planes,
                    int most_steps);

/// `sigmas`: of each set, stated or estimated as sqrt(sum of weighted squares / (points -
/// parameters)).
struct PlaneInformation {
    std::vector<double> sigmas;
    /// Two tilts along `tilts_of(normal)` and an offset for each plane: J' J / sigma^2 plus the
    /// start's information, with the free sets' motions eliminated (Schur complement).
    Eigen::MatrixXd matrix;
    std::vector<double> turn_sigmas;  ///< of a turntable's turns; radians
    double chi2 = 0;                  ///< of sets with a stated sigma
    double chi2_dof = 0;
};
PlaneInformation plane_information(const PlaneFitProblem& problem, const PlaneFit& fit);

}  // namespace culet
