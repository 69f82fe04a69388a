#include "compare/calibration/score_misfit.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "compare/calibration/level_curve.h"
#include "stone/dense_algebra.h"

namespace culet {

namespace {

// On the scores' logarithmic scales: below, draws agree by chance.
constexpr double k_least_deviation = 1e-3;

bool is_missing(double score) {
    return std::isnan(score);
}

}  // namespace

double ScoreMisfit::standardised(std::size_t score, double value, double log_error) const {
    return (value - interpolated(levels_, curves_[score], log_error)) /
           interpolated(levels_, deviations_[score], log_error);
}

ScoreMisfit::ScoreMisfit(std::vector<double> levels, std::vector<std::vector<double>> curves,
                         const std::vector<KnownScores>& draws)
    : levels_(std::move(levels)), curves_(std::move(curves)) {
    const std::size_t count = curves_.size();
    for (std::size_t s = 0; s < count; ++s) {
        std::vector<double> squares(levels_.size(), 0), counts(levels_.size(), 0);
        for (const KnownScores& draw : draws) {
            if (is_missing(draw.scores[s])) continue;
            squares[draw.level] += std::pow(draw.scores[s] - curves_[s][draw.level], 2);
            ++counts[draw.level];
        }
        for (std::size_t l = 0; l < levels_.size(); ++l)
            squares[l] = counts[l] > 0 ? squares[l] / counts[l] : 1;
        deviations_.push_back(smoothed(squares));
        for (double& d : deviations_.back()) d = std::max(k_least_deviation, std::sqrt(d));
    }
    const auto size = static_cast<Eigen::Index>(count);
    Eigen::MatrixXd products = Eigen::MatrixXd::Zero(size, size);
    double complete = 0;
    for (const KnownScores& draw : draws) {
        if (std::any_of(draw.scores.begin(), draw.scores.end(), is_missing)) continue;
        Eigen::VectorXd z(size);
        for (std::size_t s = 0; s < count; ++s)
            z[static_cast<Eigen::Index>(s)] = standardised(s, draw.scores[s], levels_[draw.level]);
        products.noalias() += z * z.transpose();
        ++complete;
    }
    const double known = complete / (complete + static_cast<double>(count));
    for (Eigen::Index a = 0; a < size; ++a) {
        for (Eigen::Index b = 0; b < size; ++b) {
            const double scale = std::sqrt(products(a, a) * products(b, b));
            const double own = scale > 0 ? products(a, b) / scale : 0;
            correlations_.push_back(a == b ? 1 : known * own);
        }
    }
}

std::optional<double> ScoreMisfit::at(double log_error, const std::vector<double>& scores) const {
    std::vector<std::size_t> known;
    for (std::size_t s = 0; s < curves_.size(); ++s)
        if (!is_missing(scores[s])) known.push_back(s);
    if (known.empty()) return std::nullopt;
    const auto count = static_cast<Eigen::Index>(known.size());
    Eigen::MatrixXd matrix(count, count);
    Eigen::VectorXd z(count);
    for (Eigen::Index a = 0; a < count; ++a) {
        const std::size_t s = known[static_cast<std::size_t>(a)];
        z[a] = standardised(s, std::min(scores[s], curves_[s].front()), log_error);
        for (Eigen::Index b = 0; b < count; ++b)
            matrix(a, b) = correlations_[s * curves_.size() + known[static_cast<std::size_t>(b)]];
    }
    return Cholesky(matrix).solve_lower(z).squaredNorm() / static_cast<double>(count);
}

}  // namespace culet
