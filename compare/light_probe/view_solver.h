#pragma once
// Least squares for the turn between two views of a ball, and how sure of it they make us.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "compare/light_probe/view_alignment.h"

namespace culet {

/// A small rotation (3), the outlines' x, y, radius (2 x 3), 1 / distance, log2 gain.
constexpr int k_view_parameters = 11;
using ViewParameters = Eigen::Matrix<double, k_view_parameters, 1>;

/// Two views, what is known of them beforehand, and the rotation that parameters start from.
struct ViewPair {
    const BallView &first, &second;
    ViewPrior first_prior, second_prior;
    glm::dmat3 start{1.0};
    bool find_distance = false;

    glm::dmat3 rotation(const ViewParameters& p) const;
    MirrorBall ball(const ViewParameters& p, bool is_second) const;
};

/// What the two views say of one direction or pixel.
struct ViewCorrespondence {
    double weight = 0;  ///< over 0
    Vec3 direction{0};  ///< in the first camera's frame: neighbours err together
};

/// Differences in stops, one a witness: second plus gain less first; k_unseen where a side sees
/// nothing.
using ViewResiduals = std::function<std::vector<double>(const ViewParameters&)>;
constexpr double k_unseen = 1e9;

struct ViewSolution {
    ViewParameters at = ViewParameters::Zero();
    double residual = 0;  ///< median disagreement, stops
    double sigma = 0;     ///< of the rotation about one axis, radians
    double correspondences =
        0;  ///< so many independent ones are all of them worth; 0: not known yet
};

/// Least squares with Cauchy's loss (Ceres), the outlines held by their sigmas.
///
/// Neighbouring pixels are wrong together: each edge of a light is off by what the pictures' grids
/// do to it. Counted as independent they would outvote the outlines' sigmas and promise too much.
/// So the scatter of their pull is taken over patches of the sphere (White 1980; Liang and Zeger
/// 1986): how much larger it is than that of independent ones says by what all are to be divided
/// (from `start` on, for the next solution), and gives the rotation's sigma.
ViewSolution solve_views(const ViewPair& pair,
                         const std::vector<ViewCorrespondence>& correspondences,
                         const ViewResiduals& residuals, ViewSolution start);

/// Where a parameter of 1 / distance begins that is to be found.
constexpr double k_unknown_distance = 30;

}  // namespace culet
