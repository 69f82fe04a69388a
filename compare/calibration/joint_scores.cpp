#include "compare/calibration/joint_scores.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/calibration/level_curve.h"
#include "stone/numbers/dense_algebra.h"

namespace culet {

namespace {

constexpr int k_steps = 400;  // over all levels: 1 % of the error between 0.01 and 2 degrees
// On the scores' logarithmic scales; a smaller spread is chance agreement.
constexpr double k_least_deviation = 1e-3;

}  // namespace

JointScores::JointScores(const JointDraws& draws) : levels_(draws.levels), curves_(draws.curves) {
    const std::size_t scores = curves_.size(), levels = levels_.size();
    for (std::size_t s = 0; s < scores; ++s) {
        std::vector<double> variances;
        for (std::size_t l = 0; l < levels; ++l) {
            double sum = 0, count = 0;
            for (const auto& draw : draws.draws[l]) {
                if (std::isnan(draw[s])) continue;
                const double off = draw[s] - curves_[s][l];
                sum += off * off;
                ++count;
            }
            variances.push_back(count > 0 ? sum / count : 1);
        }
        deviations_.emplace_back();
        for (const double variance : smoothed(variances))
            deviations_[s].push_back(std::max(k_least_deviation, std::sqrt(variance)));
    }
    std::vector<double> products(scores * scores, 0.0);
    double complete = 0;
    for (std::size_t l = 0; l < levels; ++l) {
        for (const auto& draw : draws.draws[l]) {
            if (std::any_of(draw.begin(), draw.end(), [](double v) { return std::isnan(v); }))
                continue;
            ++complete;
            for (std::size_t a = 0; a < scores; ++a) {
                for (std::size_t b = 0; b < scores; ++b) {
                    products[a * scores + b] += (draw[a] - curves_[a][l]) / deviations_[a][l] *
                                                (draw[b] - curves_[b][l]) / deviations_[b][l];
                }
            }
        }
    }
    const double known = complete / (complete + static_cast<double>(scores));
    correlations_.assign(scores * scores, 0.0);
    for (std::size_t a = 0; a < scores; ++a) {
        for (std::size_t b = 0; b < scores; ++b) {
            const double size = std::sqrt(products[a * scores + a] * products[b * scores + b]);
            const double own = size > 0 ? products[a * scores + b] / size : 0;
            correlations_[a * scores + b] = a == b ? 1 : known * own;
        }
    }
    double largest = 0;
    for (const auto& level : draws.draws) {
        for (const auto& draw : level)
            if (const auto answer = fitted(draw)) largest = std::max(largest, answer->misfit);
    }
    if (largest > 0) largest_ = largest;
}

std::optional<JointScores::Answer> JointScores::fitted(const std::vector<double>& scores) const {
    std::vector<std::size_t> known;
    for (std::size_t s = 0; s < curves_.size(); ++s)
        if (!std::isnan(scores[s])) known.push_back(s);
    if (known.empty() || levels_.size() < 2) return std::nullopt;
    const auto count = static_cast<Eigen::Index>(known.size());
    Eigen::MatrixXd matrix(count, count);
    for (Eigen::Index a = 0; a < count; ++a) {
        for (Eigen::Index b = 0; b < count; ++b) {
            matrix(a, b) = correlations_[known[static_cast<std::size_t>(a)] * curves_.size() +
                                         known[static_cast<std::size_t>(b)]];
        }
    }
    const Cholesky factor(matrix);
    const double step = (levels_.back() - levels_.front()) / k_steps;
    Answer best{levels_.front(), std::numeric_limits<double>::infinity()};
    Eigen::VectorXd z(count);
    for (int i = 0; i <= k_steps; ++i) {
        const double at = levels_.front() + i * step;
        for (Eigen::Index a = 0; a < count; ++a) {
            const std::size_t s = known[static_cast<std::size_t>(a)];
            z[a] = (scores[s] - interpolated(levels_, curves_[s], at)) /
                   interpolated(levels_, deviations_[s], at);
        }
        const double squares = factor.solve_lower(z).squaredNorm();
        if (squares < best.misfit) best = {at, squares};
    }
    best.misfit /= static_cast<double>(count);
    return best;
}

std::optional<JointScores::Answer> JointScores::of(const std::vector<double>& scores) const {
    auto answer = fitted(scores);
    if (answer) answer->misfit /= largest_;
    return answer;
}

}  // namespace culet
