#include "fit/uncertainty/meet_likelihood.h"
#include "fit/model/equations.h"
#include "fit/uncertainty/constants.h"

#include <cmath>
#include <limits>

namespace culet {

namespace {

void append(const FunctionRows& from, const Eigen::VectorXd& variance, JacobianRows& to) {
    for (Eigen::Index i = 0; i < from.rows(); ++i) {
        for (FunctionRows::InnerIterator it(from, i); it; ++it) to.add(int(it.col()), it.value());
        to.close(0, variance(i));
    }
}

void leave_readings_out(Linearised& linear) {
    std::vector<Eigen::Index> kept;
    std::vector<Equation> soft;
    for (Eigen::Index i = 0; i < linear.soft_rows.rows(); ++i) {
        const Equation& e = linear.soft[std::size_t(i)];
        if (e.group < 0 && e.role != Equation::Role::expected) continue;
        kept.push_back(i);
        soft.push_back(e);
    }
    FunctionRows rows(Eigen::Index(kept.size()), linear.soft_rows.cols());
    Eigen::VectorXd residuals(Eigen::Index(kept.size()));
    for (std::size_t i = 0; i < kept.size(); ++i) {
        rows.row(Eigen::Index(i)) = linear.soft_rows.row(kept[i]);
        residuals(Eigen::Index(i)) = linear.soft_residuals(kept[i]);
    }
    linear.soft = std::move(soft);
    linear.soft_rows = std::move(rows);
    linear.soft_residuals = std::move(residuals);
}

}  // namespace

MeetLikelihood::MeetLikelihood(const FitModel& model, const Finished& at, bool with_readings)
    : linear_(linearise(model, at.shape, at.outline)),
      stiffness_(linear_.metric / k_cov.undetermined_variance) {
    if (!with_readings) leave_readings_out(linear_);
    for (const Equation& e : linear_.soft) {
        if (e.group >= 0) present_[std::size_t(e.group)] = true;
    }
}

double MeetLikelihood::operator()(const MeetSigmas& sigmas) {
    const Eigen::Index count = linear_.soft_rows.rows();
    Eigen::VectorXd variance = Eigen::VectorXd::Ones(count);
    double logarithms = 0;
    for (Eigen::Index i = 0; i < count; ++i) {
        const Equation& e = linear_.soft[std::size_t(i)];
        if (e.group < 0) continue;
        // Rows are divided by the sigmas of the linear model.
        variance(i) = std::pow(sigmas[std::size_t(e.group)] / e.sigma, 2);
        logarithms += 2 * std::log(e.sigma);
    }
    JacobianRows rows;
    append(linear_.hard_rows, Eigen::VectorXd::Zero(linear_.hard_rows.rows()), rows);
    for (const Eigen::VectorXd& gauge : linear_.gauge_rows) {
        append(FunctionRows(gauge.transpose().sparseView()), Eigen::VectorXd::Zero(1), rows);
    }
    append(linear_.soft_rows, variance, rows);
    constexpr double k_none = std::numeric_limits<double>::infinity();
    if (!solver_.factor(rows, stiffness_)) return k_none;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(rows.count());
    right.tail(count) = -linear_.soft_residuals;
    const auto solved = solver_.solve(Eigen::VectorXd::Zero(linear_.layout.size()), right);
    if (!solved.good) return k_none;
    const Eigen::VectorXd left = linear_.soft_residuals + linear_.soft_rows * solved.unknowns;
    return solver_.log_determinant() + logarithms + left.cwiseAbs2().cwiseQuotient(variance).sum() +
           solved.unknowns.cwiseAbs2().dot(stiffness_);
}

}  // namespace culet
