#pragma once
// Finds wrong readings: data snooping for several errors at once, after Baarda (1968). Private to
// the room: shows Eigen.

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace culet {

/// Residuals of a least-squares fit in units of sigma. R = 1 - hat matrix: residuals = R errors.
struct Residuals {
    Eigen::VectorXd values;
    Eigen::VectorXd redundancy;                           ///< diagonal of R
    std::function<Eigen::VectorXd(Eigen::Index)> column;  ///< of R
};

struct Outlier {
    Eigen::Index equation = -1;
    /// The error that explains the residuals without the other outliers, and its standard
    /// uncertainty; in sigmas.
    double error = 0, error_sigma = 0;
    double gain = 0;  ///< rise of chi2 if it alone is believed again
    /// Equations that explain the residuals nearly as well (likelihood ratio below e^1.5).
    std::vector<Eigen::Index> alternatives;
};

/// The set of equations without which nothing stands out, the worst first. It grows by the best one
/// or two at a time (two errors may hide each other), and is pruned and exchanged until no change
/// improves it. One enters if chi2 drops by more than `limit`^2, a pair by more than `pair_limit`.
/// Equations of redundancy below 1e-4 cannot be checked. The search ends if a tenth of the rest
/// still stands out when eight are left out, or at forty: then no few readings explain it.
std::vector<Outlier> find_outliers(const Residuals& residuals, double limit, double pair_limit,
                                   std::size_t most);

}  // namespace culet
