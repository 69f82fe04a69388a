#include "fit/uncertainty/condition_tests.h"

#include <cmath>

#include "fit/model/datum_defect.h"
#include "fit/uncertainty/constants.h"
#include "fit/uncertainty/statistics.h"
#include "stone/numbers/dense_algebra.h"

namespace culet {

namespace {

// Of a covariance matrix, without the directions that are rounding error.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& v) {
    const Eigen::Index count = v.rows();
    Eigen::VectorXd scale(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        scale(i) = v(i, i) > k_cov.rounding_variance ? 1 / std::sqrt(v(i, i)) : 0;
    }
    const Eigen::MatrixXd correlation = scale.asDiagonal() * v * scale.asDiagonal();
    const Cholesky factor(correlation);
    Eigen::MatrixXd inverse;
    if (factor.good() && factor.least_pivot() > k_cov.least_own) {
        inverse = factor.inverse();
    } else {
        const SymmetricEigen eigen = symmetric_eigen(correlation);
        const Eigen::VectorXd inverses =
            eigen.values.unaryExpr([](double x) { return x > k_cov.least_own ? 1 / x : 0; });
        inverse = times_transpose(eigen.vectors * inverses.asDiagonal(), eigen.vectors);
    }
    return scale.asDiagonal() * inverse * scale.asDiagonal();
}

}  // namespace

Multipliers multipliers_of(const Covariance& without, const FunctionRows& rows,
                           const Eigen::VectorXd& residuals) {
    if (rows.rows() == 0 || !without.usable()) {
        return {Eigen::VectorXd::Zero(rows.rows()),
                Eigen::MatrixXd::Zero(rows.rows(), rows.rows())};
    }
    Multipliers result;
    result.covariance = pseudo_inverse(without.joint(rows));
    result.values = result.covariance * (residuals + rows * without.step());
    return result;
}

Covariance keeping(const Linearised& linear, const Combinations& kept) {
    Linearised fewer = linear;
    fewer.hard.clear();
    fewer.hard_rows = kept * linear.hard_rows;
    fewer.hard_residuals = kept * linear.hard_residuals;
    fewer.has_prior = true;
    // Few functions are needed: faster than dense algebra for all unknowns.
    return Covariance(std::move(fewer), Covariance::Algorithm::sparse);
}

Eigen::MatrixXd reach_of(const Linearised& linear, const FunctionRows& rows) {
    Linearised bare = linear;
    bare.turn.resize(0);
    const Eigen::MatrixXd unseen = rows * datum_defect(bare);
    bare.gauge_rows.clear();
    bare.soft.clear();
    const Eigen::VectorXd weights = linear.metric.cwiseSqrt();
    bare.soft_rows = FunctionRows(Eigen::MatrixXd(weights.asDiagonal()).sparseView());
    bare.soft_residuals = Eigen::VectorXd::Zero(weights.size());
    bare.has_prior = true;
    const Covariance free(std::move(bare));
    if (!free.usable()) return {};
    return free.joint(rows) - times_transpose(unseen, unseen);
}

QuadraticTest quadratic_test(const Eigen::VectorXd& x, const Eigen::MatrixXd& v, double least,
                             double largest) {
    QuadraticTest test;
    test.conditions = static_cast<int>(x.size());
    if (x.size() == 0) return test;
    const SymmetricEigen eigen = symmetric_eigen(v);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        const double variance = eigen.values(i);
        if (!(variance >= least) || !(variance <= largest)) continue;
        const double along = eigen.vectors.col(i).dot(x);
        test.statistic += along * along / variance;
        ++test.tested;
    }
    test.p = chi2_tail(test.statistic, test.tested);
    return test;
}

}  // namespace culet
