#pragma once
// Which readings are wrong: data snooping after Baarda (1968), for several errors at once.
// Private to the room: shows Eigen.

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace culet {

/// Residuals of a least-squares fit in units of sigma, and how they hang together: R = 1 - hat
/// matrix, so that residuals = R errors.
struct Residuals {
    Eigen::VectorXd values;
    Eigen::VectorXd redundancy;                           ///< diagonal of R
    std::function<Eigen::VectorXd(Eigen::Index)> column;  ///< of R
};

struct Outlier {
    Eigen::Index equation = -1;
    /// The error in units of sigma that explains the residuals, with the other outliers left out,
    /// and its own standard uncertainty.
    double error = 0, error_sigma = 0;
    double gain = 0;  ///< by how much chi2 rises when it alone is believed again
    /// Equations that would explain them nearly as well (likelihood ratio below e^1.5): what cannot
    /// be told apart from this one.
    std::vector<Eigen::Index> alternatives;
};

/// The set of equations that, left out, leaves nothing standing out: grown by the best one or the
/// best two at a time (two errors may hide each other), pruned and exchanged until no change makes
/// it better. An equation enters when chi2 drops by more than `limit`^2, two together when it drops
/// by more than `pair_limit`. The gravest first. Equations whose redundancy is below 1e-4 cannot be
/// checked. The search ends early where more than a tenth of the rest stands out still when eight
/// are left out, or when forty are not enough: no few readings explain it.
std::vector<Outlier> find_outliers(const Residuals& residuals, double limit, double pair_limit,
                                   std::size_t most);

}  // namespace culet
