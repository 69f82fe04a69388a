#pragma once
// Spectra that stand for red, green and blue light.

#include <Eigen/Core>
#include <array>
#include <vector>

namespace culet {

/// The three smoothest spectra that sum to 1 and integrate to red, green and blue: least squares of
/// first differences under linear constraints. Negative values are fixed at 0 while the integrals
/// can stay exact. If they cannot (two nodes, or all nodes where the eye sees nothing), the sum
/// stays 1 and the integrals are approximated. `rgb_weight`: 3 rows, a column per wavelength.
std::array<std::vector<double>, 3> smooth_primaries(const Eigen::MatrixXd& rgb_weight,
                                                    const std::vector<double>& nm);

}  // namespace culet
