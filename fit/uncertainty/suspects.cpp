#include "fit/uncertainty/suspects.h"

#include <algorithm>

#include "fit/uncertainty/constants.h"
#include "fit/uncertainty/covariance.h"
#include "fit/uncertainty/inconsistent_subset.h"
#include "fit/uncertainty/observations.h"
#include "fit/uncertainty/snooping.h"
#include "fit/uncertainty/statistics.h"

namespace culet {

namespace {

// The result refers to its arguments whenever columns are asked for.
Residuals residuals_of(const std::vector<Observation>& observations, const Covariance& covariance) {
    const Linearised& linear = covariance.linear();
    const Eigen::Index count = static_cast<Eigen::Index>(observations.size());
    // At the optimum the residuals are R times the errors; elsewhere a step's part is subtracted
    // first.
    const Eigen::VectorXd taken = covariance.fitted_part(linear.soft_residuals);
    Residuals residuals;
    residuals.values.resize(count);
    residuals.redundancy.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const Observation& o = observations[std::size_t(i)];
        residuals.values(i) = o.residual(linear) - o.part * taken(o.equation);
        residuals.redundancy(i) = 1 - o.leverage(covariance);
    }
    residuals.column = [&observations, &covariance, count](Eigen::Index i) {
        const Observation& one = observations[std::size_t(i)];
        const Eigen::VectorXd all = covariance.leverage_column(one.equation);
        Eigen::VectorXd column(count);
        for (Eigen::Index k = 0; k < count; ++k) {
            const Observation& other = observations[std::size_t(k)];
            column(k) = -one.part * other.part * all(other.equation);
        }
        column(i) = 1 - one.leverage(covariance);
        return column;
    };
    return residuals;
}

void name_suspects(const FitModel& model, const std::vector<Observation>& observations,
                   const std::vector<Outlier>& outliers, Diagnosis& diagnosis) {
    const auto reading_of = [&](Eigen::Index i) { return observations[std::size_t(i)].reading; };
    for (const Outlier& outlier : outliers) {
        const int reading = reading_of(outlier.equation);
        if (reading < 0 || diagnosis.readings[std::size_t(reading)].suspect) continue;
        diagnosis.readings[std::size_t(reading)].suspect = true;
        diagnosis.suspects.push_back(reading);
        const Reading& named = model.readings()[std::size_t(reading)];
        const double unit =
            observations[std::size_t(outlier.equation)].sigma * model.frame().unit_of(named);
        Suspicion suspicion{
            reading, named.value - outlier.error * unit, outlier.error_sigma * unit, {}};
        for (const Eigen::Index other : outlier.alternatives) {
            const int alternative = reading_of(other);
            if (alternative >= 0 && alternative != reading) {
                suspicion.alternatives.push_back(alternative);
            }
        }
        diagnosis.suspicions.push_back(std::move(suspicion));
    }
}

}  // namespace

void find_suspects(const FitModel& model, double significance, Diagnosis& diagnosis) {
    const Covariance& covariance = *diagnosis.covariance;
    const std::vector<Observation> observations = observations_of(covariance.linear());
    const Eigen::Index count = static_cast<Eigen::Index>(observations.size());
    const Residuals residuals = residuals_of(observations, covariance);
    const double pairs = std::max(1.0, 0.5 * double(count) * double(count - 1));
    const std::vector<Outlier> outliers =
        find_outliers(residuals, diagnosis.suspect_limit, chi2_quantile(significance / pairs, 2),
                      std::max<std::size_t>(3, observations.size() / 10));
    name_suspects(model, observations, outliers, diagnosis);
    if (!(chi2_tail(diagnosis.chi2, diagnosis.dof) < significance) ||
        count > k_snooping.most_equations) {
        return;
    }
    Eigen::MatrixXd matrix(count, count);
    std::vector<int> owner;
    for (Eigen::Index i = 0; i < count; ++i) {
        matrix.col(i) = residuals.column(i);
        owner.push_back(observations[std::size_t(i)].reading);
    }
    diagnosis.disagreeing =
        disagreeing_readings(residuals.values, std::move(matrix), owner, significance);
}

}  // namespace culet
