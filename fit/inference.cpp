#include "fit/inference.h"

#include <Eigen/Eigenvalues>

#include "fit/statistics.h"

namespace culet {

Inference::Inference(const System& system, const Shape& shape,
                     const std::shared_ptr<const Outline>& outline,
                     const std::vector<Equation>& held)
    : linear_(linearise(system, shape, outline, false, held)),
      writer_(shape),
      solver_(linear_, 1 / k_unheld_variance) {
    if (!solver_.usable()) return;
    const Eigen::VectorXd gradient = linear_.soft_rows.transpose() * linear_.soft_residuals;
    multipliers_ =
        solver_.solve_with_multipliers(-gradient, Eigen::VectorXd::Zero(linear_.hard_rows.rows()))
            .tail(linear_.hard_rows.rows());
}

Eigen::MatrixXd Inference::rows_of(const std::vector<Quantity>& quantities) const {
    Eigen::MatrixXd rows(Eigen::Index(quantities.size()), linear_.layout.size());
    for (std::size_t i = 0; i < quantities.size(); ++i) {
        rows.row(Eigen::Index(i)) = Eigen::VectorXd(writer_.function(quantities[i])).transpose();
    }
    return rows;
}

Eigen::MatrixXd Inference::times_covariance(const Eigen::MatrixXd& rows) const {
    Eigen::MatrixXd result(linear_.layout.size(), rows.rows());
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(linear_.hard_rows.rows());
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        result.col(i) = solver_.solve(rows.row(i).transpose(), none);
    }
    return result;
}

Eigen::MatrixXd Inference::covariance(const Eigen::MatrixXd& rows) const {
    const Eigen::MatrixXd product = rows * times_covariance(rows);
    return 0.5 * (product + product.transpose());
}

Eigen::MatrixXd Inference::multiplier_covariance(const Eigen::MatrixXd& combinations) const {
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(linear_.layout.size());
    Eigen::MatrixXd solved(combinations.rows(), combinations.cols());
    for (Eigen::Index i = 0; i < combinations.cols(); ++i) {
        // The lower right block of the inverse is minus the covariance.
        solved.col(i) =
            -solver_.solve_with_multipliers(none, combinations.col(i)).tail(combinations.rows());
    }
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
