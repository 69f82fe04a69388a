#include "compare/calibration/tilt_variance.h"

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "stone/numbers/dense_algebra.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Divides the columns by the noise.
Eigen::MatrixXd whitened(const std::vector<std::vector<double>>& columns,
                         const Eigen::VectorXd& noise) {
    Eigen::MatrixXd matrix(noise.size(), static_cast<Eigen::Index>(columns.size()));
    for (std::size_t k = 0; k < columns.size(); ++k) {
        check(columns[k].size() == static_cast<std::size_t>(noise.size()),
              "a column of a tilt model has not a value for each sample");
        matrix.col(static_cast<Eigen::Index>(k)) =
            Eigen::Map<const Eigen::VectorXd>(columns[k].data(), noise.size()).cwiseQuotient(noise);
    }
    return matrix;
}

// Orthonormal basis of the columns' span.
Eigen::MatrixXd span_of(const Eigen::MatrixXd& columns) {
    if (columns.cols() == 0) return columns;
    const PivotedQr parts(columns);
    return parts.first(parts.rank());
}

}  // namespace

TiltVariance::TiltVariance(const TiltModel& model) : samples_(model.noise.size()) {
    const Eigen::Map<const Eigen::VectorXd> noise(model.noise.data(),
                                                  static_cast<Eigen::Index>(samples_));
    if (samples_ == 0 || model.changes.empty()) return;
    Eigen::MatrixXd changes = whitened(model.changes, noise);
    const double before = changes.squaredNorm();
    const Eigen::MatrixXd nuisances = span_of(whitened(model.nuisances, noise));
    changes = orthogonal_part(changes, nuisances);

    const SymmetricEigen parts = symmetric_eigen(transpose_times(changes, changes));
    // From the largest; eigenvalues of directions without effect are only rounding error.
    const Eigen::VectorXd squares = parts.values.reverse();
    const Eigen::MatrixXd directions = parts.vectors.rowwise().reverse();
    const double rounding =
        static_cast<double>(samples_) * std::numeric_limits<double>::epsilon() * before;
    Eigen::Index seen = 0;
    while (seen < squares.size() && squares[seen] > rounding) ++seen;
    if (seen == 0) return;

    const double noise_square = squares[seen / 2];
    const Eigen::ArrayXd weights =
        (squares.head(seen).array() / (squares.head(seen).array() + noise_square)).square();
    // (y / s) of a difference is the product with changes * direction / s^2.
    const Eigen::VectorXd lengths =
        ((weights / weights.sum()).sqrt() / squares.head(seen).array()).matrix();
    const Eigen::MatrixXd along =
        product(changes, directions.leftCols(seen) * lengths.asDiagonal());
    rows_.resize(static_cast<std::size_t>(seen) * samples_);
    Eigen::Map<Rows>(rows_.data(), seen, noise.size()) =
        (noise.cwiseInverse().asDiagonal() * along).transpose().cast<float>();
}

std::optional<double> TiltVariance::rms(const std::vector<double>& difference) const {
    check(difference.size() == samples_, "a difference has not a value for each sample");
    if (!usable()) return std::nullopt;
    const auto samples = static_cast<Eigen::Index>(samples_);
    const Eigen::Map<const Rows> rows(rows_.data(),
                                      static_cast<Eigen::Index>(rows_.size() / samples_), samples);
    const Eigen::Map<const Eigen::VectorXd> values(difference.data(), samples);
    // Row by row, so that the order of summation is fixed.
    double sum = 0;
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        sum += std::pow(rows.row(i).cast<double>().dot(values), 2);
    }
    return std::sqrt(sum);
}

}  // namespace culet
