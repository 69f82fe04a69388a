#include "compare/refine/picture_equations.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "compare/calibration/stone_samples.h"
#include "stone/numbers/dense_algebra.h"
#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

constexpr double k_huber = 2;        // deviations beyond which a sample's weight falls
constexpr int k_rounds = 3;          // of weights and noise, which settle in two
constexpr double k_rounding = 1e-9;  // of the largest eigenvalue
// Range of the noise's correlation. Blurred noise has exp(-d^2 / 4 blur^2), a ten-millionth at 8;
// other errors reach farther.
constexpr double k_reach = 8;  // blurs
// Lower limit in units of a sample's `noise`: even two equal pictures say nothing finer.
constexpr double k_noise_floor = 0.1;
// Smallest ratio of a direction's prior variance to the picture's that counts as information.
constexpr double k_least_information = 0.01;
// A picture cannot determine more moves than it has independent samples.
constexpr double k_most_determined = 0.75;

double typical(const Eigen::VectorXd& values) {
    std::vector<double> sizes;
    for (const double v : values) sizes.push_back(std::abs(v));
    return sizes.empty() ? 0 : 1.4826 * upper_median(sizes);
}

cv::Mat as_picture(const Eigen::VectorXd& values, const cv::Mat& mask) {
    cv::Mat picture = cv::Mat::zeros(mask.size(), CV_32F);
    Eigen::Index i = 0;
    for (int y = 0; y < mask.rows; ++y) {
        for (int x = 0; x < mask.cols; ++x) {
            if (mask.at<unsigned char>(y, x)) picture.at<float>(y, x) = float(values[i++]);
        }
    }
    return picture;
}

// Correlation of blurred white noise at each offset: exp(-d^2 / 4 blur^2).
cv::Mat blurred_correlation(int reach, double blur) {
    cv::Mat correlation(2 * reach + 1, 2 * reach + 1, CV_32F);
    for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
            correlation.at<float>(y + reach, x + reach) =
                float(std::exp(-(x * x + y * y) / (4 * blur * blur)));
        }
    }
    return correlation;
}

// Bartlett's weights of pairs at each offset, which keep the sum non-negative, over the share of
// such noise that they keep.
cv::Mat pair_weights(const cv::Mat& correlation) {
    const int reach = correlation.rows / 2;
    cv::Mat line(correlation.rows, 1, CV_32F);
    for (int y = -reach; y <= reach; ++y) {
        line.at<float>(y + reach) = float(1 - std::abs(y) / (reach + 1.0));
    }
    const cv::Mat weights = line * line.t();
    return weights * (cv::sum(correlation)[0] / weights.dot(correlation));
}

// Sums over all pairs of samples of the columns' weighted products.
Eigen::MatrixXd pair_sums(const Eigen::MatrixXd& columns, const cv::Mat& mask,
                          const cv::Mat& weights) {
    Eigen::MatrixXd near(columns.rows(), columns.cols());
    for (Eigen::Index k = 0; k < columns.cols(); ++k) {
        cv::Mat sums;
        cv::filter2D(as_picture(columns.col(k), mask), sums, CV_32F, weights, cv::Point(-1, -1), 0,
                     cv::BORDER_CONSTANT);
        const std::vector<double> values = samples_of(sums, mask);
        near.col(k) = Eigen::Map<const Eigen::VectorXd>(values.data(), columns.rows());
    }
    const Eigen::MatrixXd sums = transpose_times(columns, near);
    return (sums + sums.transpose()) / 2;
}

// Divided by the noise, with the nuisances projected out.
struct Weighted {
    Eigen::MatrixXd changes, nuisances;
    Eigen::VectorXd difference;
};

Weighted weighted(const PictureEquations& e, const Eigen::VectorXd& weights) {
    const Eigen::VectorXd scale = weights.cwiseSqrt().cwiseQuotient(e.noise);
    return {scale.asDiagonal() * e.changes, scale.asDiagonal() * e.nuisances,
            scale.cwiseProduct(e.difference)};
}

// Orthonormal basis of the columns' span, whatever the columns' units.
Eigen::MatrixXd span_of(Eigen::MatrixXd columns) {
    for (Eigen::Index k = 0; k < columns.cols(); ++k) {
        const double length = columns.col(k).norm();
        if (length > 0) columns.col(k) /= length;
    }
    const PivotedQr parts(columns);
    return parts.first(parts.rank());
}

// Effective number of independent samples, by the correlation of the residuals. `area`: that of
// blurred white noise.
double independent_samples(const Eigen::VectorXd& residual, const cv::Mat& mask,
                           const cv::Mat& weights, double area) {
    const double samples = double(residual.size()), squares = residual.squaredNorm();
    if (!(squares > 0)) return samples / area;
    return samples * squares / std::max(pair_sums(residual, mask, weights)(0, 0), squares);
}

// Takes a vector of this covariance to one of unit covariance.
Eigen::MatrixXd whitening(const Eigen::MatrixXd& covariance) {
    const SymmetricEigen parts = symmetric_eigen(covariance);
    const Eigen::VectorXd floor =
        Eigen::VectorXd::Constant(covariance.rows(), k_rounding * parts.values.maxCoeff());
    return parts.values.cwiseMax(floor).cwiseSqrt().cwiseInverse().asDiagonal() *
           parts.vectors.transpose();
}

// The moves by the rows and the prior, and how many of them the rows determine.
void solve(const Eigen::VectorXd& prior, DeterminedMoves& determined, Eigen::VectorXd& moves) {
    const Eigen::MatrixXd information = transpose_times(determined.rows, determined.rows);
    const PivotedCholesky both(information + Eigen::MatrixXd(prior.asDiagonal()));
    moves = both.solve_one(determined.rows.transpose() * determined.values);
    determined.parameters_determined = both.solve(information).trace();
}

Eigen::VectorXd huber_weights(const Eigen::VectorXd& off, double noise) {
    return (k_huber * noise * off.cwiseAbs().cwiseMax(k_noise_floor).cwiseInverse().array())
        .min(1.0)
        .matrix();
}

// Keeps independent rows that add to the prior: directions that the picture hardly sees would add
// only noise.
void keep_informative(const Eigen::VectorXd& spread, DeterminedMoves& determined) {
    const Eigen::MatrixXd scaled = determined.rows * spread.asDiagonal();
    const SymmetricEigen parts = symmetric_eigen(transpose_times(scaled, scaled));
    const Eigen::Index all = spread.size();
    Eigen::Index first = 0;
    while (first < all && !(parts.values[first] > k_least_information)) ++first;
    const Eigen::VectorXd lengths = parts.values.tail(all - first).cwiseSqrt();
    const Eigen::MatrixXd along = parts.vectors.rightCols(all - first).transpose();
    determined.values =
        lengths.cwiseInverse().asDiagonal() * (along * (scaled.transpose() * determined.values));
    determined.rows = lengths.asDiagonal() * along * spread.cwiseInverse().asDiagonal();
}

}  // namespace

DeterminedMoves solved_moves(const PictureEquations& e) {
    const Eigen::Index samples = e.difference.size();
    const Eigen::VectorXd prior = e.spread.cwiseAbs2().cwiseInverse();
    DeterminedMoves determined;
    determined.weights = Eigen::VectorXd::Ones(samples);
    const int reach =
        std::min(int(std::ceil(k_reach * e.blur)), std::min(e.mask.rows, e.mask.cols) / 3);
    const cv::Mat correlation = blurred_correlation(reach, e.blur);
    const cv::Mat weights = pair_weights(correlation);
    const Eigen::VectorXd nonlinearity = e.nonlinearity.cwiseQuotient(e.noise);
    // Number of samples that are worth one independent sample of blurred white noise.
    const double area = 4 * CV_PI * e.blur * e.blur;
    Eigen::VectorXd moves;
    for (int round = 0; round < k_rounds; ++round) {
        const Weighted w = weighted(e, determined.weights);
        const Eigen::MatrixXd open = span_of(w.nuisances);
        const Eigen::MatrixXd changes = orthogonal_part(w.changes, open);
        const Eigen::VectorXd difference = w.difference - open * (open.transpose() * w.difference);
        const Eigen::MatrixXd normal = transpose_times(changes, changes);
        const Eigen::VectorXd sums = changes.transpose() * difference;
        if (round == 0) {
            const double noise = std::pow(std::max(typical(difference), k_noise_floor), 2) * area;
            moves = PivotedCholesky(normal / noise + Eigen::MatrixXd(prior.asDiagonal()))
                        .solve_one(sums / noise);
        }
        const Eigen::VectorXd residual = difference - changes * moves;
        const Eigen::MatrixXd covariance =
            pair_sums(residual.asDiagonal() * changes, e.mask, weights) +
            pair_sums(nonlinearity.asDiagonal() * changes, e.mask, correlation) +
            k_noise_floor * k_noise_floor * area * normal;
        determined.independent = independent_samples(residual, e.mask, weights, area);
        const Eigen::MatrixXd whiten = whitening(covariance);
        determined.rows = product(whiten, normal);
        determined.values = whiten * sums;
        solve(prior, determined, moves);
        // Corrects for the degrees of freedom that the moves have absorbed.
        const double taken =
            std::min(determined.parameters_determined / determined.independent, k_most_determined);
        determined.rows *= std::sqrt(1 - taken);
        determined.values *= std::sqrt(1 - taken);
        solve(prior, determined, moves);
        // Outliers by the noise of a single sample.
        const Eigen::VectorXd off =
            (difference - changes * moves).cwiseQuotient(determined.weights.cwiseSqrt());
        determined.noise = std::max(typical(off), k_noise_floor);
        if (round + 1 < k_rounds) determined.weights = huber_weights(off, determined.noise);
    }
    keep_informative(e.spread, determined);
    return determined;
}

Eigen::VectorXd nuisances_beside(const PictureEquations& e, const DeterminedMoves& determined,
                                 const Eigen::VectorXd& moves, const Eigen::VectorXd& spread) {
    const Weighted w = weighted(e, determined.weights);
    const Eigen::MatrixXd nuisances = w.nuisances.leftCols(spread.size());
    Eigen::MatrixXd normal = transpose_times(nuisances, nuisances);
    const double noise =
        determined.noise * determined.noise * double(e.difference.size()) / determined.independent;
    for (Eigen::Index k = 0; k < spread.size(); ++k) {
        if (spread[k] > 0) normal(k, k) += noise / (spread[k] * spread[k]);
    }
    return shortest_solution(normal, nuisances.transpose() * (w.difference - w.changes * moves));
}

}  // namespace culet
