#include "fit/uncertainty/restricted_residuals.h"

#include <cmath>
#include <limits>

#include "stone/dense_algebra.h"

namespace culet {

namespace {

// Less redundancy than this checks nothing.
constexpr double k_checked = 1e-4;
constexpr double k_ridge = 1e-10;
// Of so many equations the hat matrix has room: 8 MB.
constexpr Eigen::Index k_most_kept = 1000;

}  // namespace

RestrictedResiduals::RestrictedResiduals(const Covariance& covariance)
    : covariance_(covariance),
      count_(covariance.linear().soft_residuals.size()),
      counted_(Eigen::VectorXd::Zero(count_)) {
    const Linearised& linear = covariance.linear();
    for (Index i = 0; i < count_; ++i) {
        counted_(i) = linear.soft[std::size_t(i)].is_counted() ? 1 : 0;
    }
    values_ = linear.soft_residuals.cwiseProduct(counted_);
    values_ -= covariance.fitted_part(values_);
    redundancy_ = (counted_ - covariance.leverages()).cwiseMax(0).cwiseProduct(counted_);
    if (count_ <= k_most_kept) {
        hat_.setConstant(count_, count_, std::numeric_limits<double>::quiet_NaN());
    }
}

double RestrictedResiduals::gain_of(Index i) const {
    return redundancy_(i) > k_checked ? values_(i) * values_(i) / redundancy_(i) : 0;
}

double RestrictedResiduals::most_of(const std::vector<Index>& equations) const {
    const auto [found, is_new] = most_.try_emplace(equations, 0.0);
    if (is_new) found->second = find_most_of(equations);
    return found->second;
}

Eigen::VectorXd RestrictedResiduals::seen(const Signature& signature) const {
    Eigen::VectorXd s = Eigen::VectorXd::Zero(count_);
    for (const auto& [i, value] : signature) s(i) = value;
    Eigen::VectorXd result = s - covariance_.fitted_part(s);
    if (columns_.cols() == 0) return result;
    // R s less what the readings left out would take up.
    Eigen::VectorXd at(Index(left_out_.size()));
    for (std::size_t k = 0; k < left_out_.size(); ++k) at(Index(k)) = result(left_out_[k]);
    return result - left_out_part_ * at;
}

double RestrictedResiduals::seen_square(const Signature& signature) const {
    double square = -covariance_.fitted_square(signature);
    for (const auto& [i, value] : signature) square += value * value;
    if (columns_.cols() == 0) return square;
    Eigen::RowVectorXd at = Eigen::RowVectorXd::Zero(columns_.cols()), taken = at;
    for (const auto& [i, value] : signature) {
        at += value * columns_.row(i);
        taken += value * left_out_part_.row(i);
    }
    return square - at.dot(taken);
}

void RestrictedResiduals::add(const Eigen::VectorXd& change) {
    values_ += change;
    most_.clear();
}

void RestrictedResiduals::leave_out(Index i) {
    const double own = redundancy_(i);
    const Eigen::VectorXd column = seen({{i, 1.0}}) / own;
    values_ -= column * values_(i);
    redundancy_ -= own * column.cwiseAbs2();
    redundancy_ = redundancy_.cwiseMax(0);
    redundancy_(i) = values_(i) = 0;
    Eigen::VectorXd whole = Eigen::VectorXd::Zero(count_);
    whole(i) = 1;
    whole -= covariance_.fitted_part(whole);
    left_out_.push_back(i);
    Eigen::MatrixXd columns(count_, Index(left_out_.size()));
    columns << columns_, whole;
    columns_ = std::move(columns);
    block_.resize(columns_.cols(), columns_.cols());
    for (std::size_t k = 0; k < left_out_.size(); ++k) {
        block_.row(Index(k)) = columns_.row(left_out_[k]);
    }
    left_out_part_ = PivotedCholesky(block_).solve(columns_.transpose()).transpose();
    most_.clear();
}

double RestrictedResiduals::leverage(Index i, Index j) const {
    if (hat_.size() == 0) return covariance_.leverage(i, j);
    double& known = hat_(std::min(i, j), std::max(i, j));
    if (std::isnan(known)) known = covariance_.leverage(i, j);
    return known;
}

double RestrictedResiduals::find_most_of(const std::vector<Index>& equations) const {
    const Index count = Index(equations.size());
    Eigen::MatrixXd block(count, count);
    Eigen::VectorXd values(count);
    for (Index a = 0; a < count; ++a) {
        const Index i = equations[std::size_t(a)];
        values(a) = values_(i);
        for (Index b = 0; b <= a; ++b) {
            const Index j = equations[std::size_t(b)];
            double entry = (i == j ? 1 : 0) - leverage(i, j);
            if (columns_.cols() > 0) entry -= left_out_part_.row(i).dot(columns_.row(j));
            block(a, b) = entry + (i == j ? k_ridge : 0);
        }
    }
    const PivotedCholesky factors(block);
    return factors.is_positive() ? factors.square(values) * (1 + 1e-6) : 1e300;
}

}  // namespace culet
