#pragma once
// What calipers know whose jaws lie flush on a side of the stone, or nearly. Private to the room:
// shows Eigen.
//
// A jaw rests on the corner that stands out farthest: of two that are level, turned one way it is
// the one, turned the other way the other, and either way the stone is wider. About such a stone a
// width is no linear function of the freedoms, and the covariance of the linear model, which knows
// of one corner only, makes the side's azimuth less sure than it is. With a flat prior the readings
// say exp(-chi2 / 2), chi2 being quadratic but for the corners t that stand farther out than the
// one that is touched: (residual + max(0, t) / sigma)^2 instead of residual^2. Its second moments
// about the fit follow by quadrature over those few t and residuals; given them, everything else
// stays as linear as it was.

#include <vector>

#include "fit/covariance.h"
#include "fit/system.h"

namespace culet {

/// A reading between two jaws, about the fit: rows of small errors, in units of its sigma.
struct CaliperErrors {
    double residual = 0;  ///< of the reading, with the corners that are touched
    /// By how much other corners stand out farther than the one that is touched: below zero.
    std::array<std::vector<double>, 2> levels;
};

/// Second moments of `y`, standard normal in the linear model but for its `mean`, about zero. Each
/// caliper's errors are rows of `slopes` times y, one after another: the residual's, then those of
/// the first jaw's levels, then of the second's. The linear model's own, 1, where it is so far off
/// that quadrature fails.
Eigen::MatrixXd moments_between_jaws(const std::vector<CaliperErrors>& calipers,
                                     const Eigen::MatrixXd& slopes, const Eigen::VectorXd& mean);

/// What the second moments of functions of the unknowns are beyond their covariance in the linear
/// model. Nothing where not all meets are exact, or jaws may touch more corners than can be
/// weighed at once: sigmas are then the linear model's, a little too large.
class FlushJaws {
public:
    FlushJaws(const System& system, const Shape& shape, const Outline& outline,
              const Linearised& linear, const Covariance& covariance);
    /// Below zero, most often.
    double more_variance(const FunctionRow& function) const;

private:
    // Covariances of all unknowns with combinations of variance one, whose second moments are by
    // so much more.
    Eigen::MatrixXd with_unknowns_, more_;
};

}  // namespace culet
