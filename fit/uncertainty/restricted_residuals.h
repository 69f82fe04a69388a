#pragma once
// What of the residuals is left as explanations are taken out of them, one by one. Private to the
// room: shows Eigen.

#include <Eigen/Core>
#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "fit/uncertainty/covariance.h"

namespace culet {

/// r = R e with R = 1 - H, the projection onto what the fit leaves of errors e; in sigmas.
class RestrictedResiduals {
public:
    using Index = Eigen::Index;
    explicit RestrictedResiduals(const Covariance& covariance);

    Index size() const { return count_; }
    const Eigen::VectorXd& values() const { return values_; }
    double squares() const { return std::max(1e-300, values_.squaredNorm()); }
    /// What a wrong reading in this equation would explain.
    double gain_of(Index i) const;
    /// No signature of these equations alone lowers chi-square by more than r'R^-1 r, with both cut
    /// down to them: the maximum of -2 r's - s'Rs. Planes of all directions and depths at a place
    /// mostly change the same ones.
    double most_of(const std::vector<Index>& equations) const;
    /// What a plane changes, in sigmas, equation by equation: s.
    using Signature = std::vector<std::pair<Index, double>>;
    /// R s, as far as R is left, and s'Rs alone, which takes far less.
    Eigen::VectorXd seen(const Signature& signature) const;
    double seen_square(const Signature& signature) const;
    /// An explanation: R s.
    void add(const Eigen::VectorXd& change);
    /// An equation counts no more.
    void leave_out(Index i);

private:
    double leverage(Index i, Index j) const;
    double find_most_of(const std::vector<Index>& equations) const;

    const Covariance& covariance_;
    Index count_;
    Eigen::VectorXd counted_, values_, redundancy_;
    std::vector<Index> left_out_;
    Eigen::MatrixXd columns_ = Eigen::MatrixXd(count_, 0), block_, left_out_part_;
    mutable std::map<std::vector<Index>, double> most_;  // of what is left now
    mutable Eigen::MatrixXd hat_;  // what is known of it: NaN is not; empty when it would be large
};

}  // namespace culet
