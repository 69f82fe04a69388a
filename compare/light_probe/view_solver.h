#pragma once
// The rotation between two views of a ball by least squares, with its uncertainty.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "compare/light_probe/view_alignment.h"

namespace culet {

/// A small rotation (3), the outlines' x, y, radius (2 x 3), 1 / distance, log2 gain.
constexpr int k_view_parameters = 11;
using ViewParameters = Eigen::Matrix<double, k_view_parameters, 1>;

/// Two views, their priors, and the rotation from which the parameters start.
struct ViewPair {
    const BallView &first, &second;
    ViewPrior first_prior, second_prior;
    glm::dmat3 start{1.0};
    bool find_distance = false;

    glm::dmat3 rotation(const ViewParameters& p) const;
    MirrorBall ball(const ViewParameters& p, bool is_second) const;
};

struct ViewCorrespondence {
    double weight = 0;  ///< positive
    Vec3 direction{0};  ///< in the first camera's frame; neighbours have correlated errors
};

/// Second plus gain minus first for each correspondence, stops; k_unseen where a side sees nothing.
using ViewResiduals = std::function<std::vector<double>(const ViewParameters&)>;
constexpr double k_unseen = 1e9;

struct ViewSolution {
    ViewParameters at = ViewParameters::Zero();
    double residual = 0;  ///< median disagreement, stops
    double sigma = 0;     ///< of the rotation about one axis, radians
    double correspondences =
        0;  ///< the number of independent ones that they are worth; 0: unknown yet
};

/// Least squares with Cauchy's loss (Ceres), with the outlines' sigmas as priors.
///
/// Neighbouring pixels have correlated errors, because the sampling grids shift each edge of a
/// light as a whole. Treated as independent, they would outweigh the outlines' priors and give too
/// small a sigma. So the gradient's scatter is taken over patches of the sphere (clustered errors:
/// White 1980; Liang and Zeger 1986). Its ratio to that of independent residuals gives the
/// effective number of correspondences, for the next solution (from `start`), and the rotation's
/// sigma.
ViewSolution solve_views(const ViewPair& pair,
                         const std::vector<ViewCorrespondence>& correspondences,
                         const ViewResiduals& residuals, ViewSolution start);

/// Start value of an unknown distance.
constexpr double k_unknown_distance = 30;

}  // namespace culet
