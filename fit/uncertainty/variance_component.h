#pragma once
// Estimates how much values scatter beyond their known uncertainties. Private to the room.

#include <Eigen/Core>
#include <vector>

namespace culet {

/// Contrasts z ~ N(0, V + sigma^2 I) in the axes of V.
struct Contrasts {
    std::vector<double> values, variances;
};
/// Contrasts of deviations with covariance `v`, free of whatever `columns` explain.
Contrasts contrasts_of(const Eigen::VectorXd& deviations, const Eigen::MatrixXd& v,
                       const Eigen::MatrixXd& columns);

struct VarianceComponent {
    double sigma = 0;        ///< of the highest restricted likelihood (Patterson & Thompson 1971)
    double sigma_sigma = 0;  ///< from the expected information; if sigma is 0, from `at_most`
    double at_most = 0;      ///< one-sided 95 % limit from the likelihood ratio (chi2 / 2 = 1.353)
};
VarianceComponent variance_component(const Contrasts& contrasts);

}  // namespace culet
