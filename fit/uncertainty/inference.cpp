#include "fit/uncertainty/inference.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "fit/uncertainty/statistics.h"

namespace culet {

namespace {

// Exact equations are factored with a variance of 1e-9 and refined to none; so much larger, that
// is small beside what the best readings know, and still far above rounding.
constexpr double k_hard_scale = 30;
// Of variances: what is told of them has three digits.
constexpr double k_precision = 1e-6;

}  // namespace

Inference::Inference(const System& system, const Shape& shape,
                     const std::shared_ptr<const Outline>& outline,
                     const std::vector<Equation>& held)
    : linear_(linearise(system, shape, outline, held)), writer_(shape) {
    usable_ =
        solver_.factor(kkt_rows(linear_, true, k_hard_scale), linear_.metric / k_unheld_variance);
    if (!usable_) return;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(kkt_row_count(linear_, true));
    right.tail(linear_.soft_rows.rows()) = -linear_.soft_residuals;
    const auto solved = solver_.solve(Eigen::VectorXd::Zero(linear_.layout.size()), right);
    usable_ = solved.good;
    multipliers_ = k_hard_scale * solved.forces.head(linear_.hard_rows.rows());
}

Eigen::MatrixXd Inference::rows_of(const std::vector<Quantity>& quantities) const {
    Eigen::MatrixXd rows(Eigen::Index(quantities.size()), linear_.layout.size());
    for (std::size_t i = 0; i < quantities.size(); ++i) {
        rows.row(Eigen::Index(i)) = Eigen::VectorXd(writer_.function(quantities[i])).transpose();
    }
    return rows;
}

Eigen::MatrixXd Inference::times_covariance(const Eigen::MatrixXd& rows) const {
    return solver_.solve_all(rows.transpose(), Eigen::MatrixXd(), k_precision).unknowns;
}

Eigen::MatrixXd Inference::reach(const Eigen::MatrixXd& rows) const {
    KktSolver solver;
    if (!solver.factor(kkt_rows(linear_, false, k_hard_scale), linear_.metric))
        return Eigen::MatrixXd();
    // All digits: what is left of motions that equations forbid is told from those that they allow.
    const Eigen::MatrixXd moved = solver.solve_all(rows.transpose(), Eigen::MatrixXd()).unknowns;
    const Eigen::MatrixXd product = rows * moved;
    return 0.5 * (product + product.transpose());
}

Eigen::MatrixXd Inference::covariance(const Eigen::MatrixXd& rows) const {
    const Eigen::MatrixXd product = rows * times_covariance(rows);
    return 0.5 * (product + product.transpose());
}

std::vector<double> Inference::sigmas(const std::vector<Quantity>& quantities) const {
    constexpr std::size_t k_at_a_time = 64;
    std::vector<double> result;
    for (std::size_t from = 0; from < quantities.size(); from += k_at_a_time) {
        const std::size_t to = std::min(quantities.size(), from + k_at_a_time);
        const Eigen::MatrixXd rows = rows_of(
            {quantities.begin() + std::ptrdiff_t(from), quantities.begin() + std::ptrdiff_t(to)});
        const Eigen::MatrixXd spread = times_covariance(rows);
        for (Eigen::Index k = 0; k < rows.rows(); ++k) {
            result.push_back(std::sqrt(std::max(0.0, rows.row(k).dot(spread.col(k)))));
        }
    }
    return result;
}

Eigen::MatrixXd Inference::multiplier_covariance(const Eigen::MatrixXd& combinations) const {
    Eigen::MatrixXd right =
        Eigen::MatrixXd::Zero(kkt_row_count(linear_, true), combinations.cols());
    right.topRows(combinations.rows()) = k_hard_scale * combinations;
    // The lower right block of the inverse is minus the covariance.
    const Eigen::MatrixXd solved =
        -k_hard_scale * solver_.solve_all(Eigen::MatrixXd(), right, k_precision)
                            .forces.topRows(combinations.rows());
    const Eigen::MatrixXd product = combinations.transpose() * solved;
    return 0.5 * (product + product.transpose());
}

QuadraticTest quadratic_test(const Eigen::VectorXd& x, const Eigen::MatrixXd& v, double least,
                             double largest) {
    QuadraticTest test;
    test.conditions = static_cast<int>(x.size());
    if (x.size() == 0) return test;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(v);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        const double variance = eigen.eigenvalues()(i);
        if (!(variance >= least) || !(variance <= largest)) continue;
        const double along = eigen.eigenvectors().col(i).dot(x);
        test.statistic += along * along / variance;
        ++test.tested;
    }
    test.p = chi2_tail(test.statistic, test.tested);
    return test;
}

}  // namespace culet
