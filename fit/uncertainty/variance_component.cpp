#include "fit/uncertainty/variance_component.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "stone/numbers/dense_algebra.h"

namespace culet {

Contrasts contrasts_of(const Eigen::VectorXd& deviations, const Eigen::MatrixXd& v,
                       const Eigen::MatrixXd& columns) {
    const PivotedQr qr(columns, 1e-9);
    const Eigen::MatrixXd rest = qr.last(deviations.size() - qr.rank());
    Contrasts contrasts;
    if (rest.cols() == 0) return contrasts;
    const SymmetricEigen eigen = symmetric_eigen(congruence(rest, v));
    const Eigen::VectorXd z = eigen.vectors.transpose() * (rest.transpose() * deviations);
    for (Eigen::Index i = 0; i < z.size(); ++i) {
        contrasts.values.push_back(z(i));
        contrasts.variances.push_back(std::max(0.0, eigen.values(i)));
    }
    return contrasts;
}

VarianceComponent variance_component(const Contrasts& contrasts) {
    VarianceComponent result;
    constexpr double k_unbounded = std::numeric_limits<double>::infinity();
    const std::size_t count = contrasts.values.size();
    double largest = 0, floor = 1e-24;
    for (std::size_t i = 0; i < count; ++i) {
        largest = std::max(largest, contrasts.values[i] * contrasts.values[i]);
        if (contrasts.variances[i] < 0.25) largest = std::max(largest, contrasts.variances[i]);
    }
    if (count == 0) {
        result.sigma_sigma = result.at_most = k_unbounded;
        return result;
    }
    const auto log_likelihood = [&](double variance) {
        double sum = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const double total = contrasts.variances[i] + variance + floor;
            sum -= 0.5 * (std::log(total) + contrasts.values[i] * contrasts.values[i] / total);
        }
        return sum;
    };
    // One parameter, perhaps with several local maxima: a fine scan in ratios, then golden section.
    const double low = 1e-9 * largest + floor, high = 1e3 * largest + floor;
    const int steps = 240;
    const double ratio = std::pow(high / low, 1.0 / steps);
    double best = 0, most = log_likelihood(0);
    for (int k = 0; k <= steps; ++k) {
        const double variance = low * std::pow(ratio, k);
        const double l = log_likelihood(variance);
        if (l > most) {
            most = l;
            best = variance;
        }
    }
    if (best > 0) {
        double a = best / ratio, b = best * ratio;
        const double golden = 0.5 * (std::sqrt(5.0) - 1);
        for (int k = 0; k < 60; ++k) {
            const double c = b - golden * (b - a), d = a + golden * (b - a);
            (log_likelihood(c) > log_likelihood(d) ? b : a) =
                log_likelihood(c) > log_likelihood(d) ? d : c;
        }
        best = 0.5 * (a + b);
        most = std::max(most, log_likelihood(best));
    }
    double information = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double total = contrasts.variances[i] + best + floor;
        information += 0.5 / (total * total);
    }
    double limit = std::max(best, low);
    while (limit < 1e6 * high && log_likelihood(limit) > most - 1.3527717) limit *= 1.02;
    result.sigma = std::sqrt(best);
    result.at_most = limit < 1e6 * high ? std::sqrt(limit) : k_unbounded;
    // d(sigma) = d(variance) / (2 sigma)
    result.sigma_sigma =
        best > low ? 1 / (2 * result.sigma * std::sqrt(information)) : result.at_most / 1.6448536;
    return result;
}

}  // namespace culet
