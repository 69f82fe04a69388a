#include "fit/flush_jaws.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace culet {

namespace {

// Corners that are more sigmas lower are not touched: in one of 700 cases.
constexpr double k_farthest = 3;
// What cannot change a reading by more than this part of its sigma changes no uncertainty.
constexpr double k_least = 0.1;
// Below the touched corner, in half diameters: what is lower is out of reach for any stone that
// was measured at all.
constexpr double k_far_below = 0.1;
// Level, in sigmas of what is known of the difference.
constexpr double k_level = 1e-3;
constexpr int k_points = 512, k_most_rounds = 8;
// With more errors to draw at once, or where fewer points than so many for each of them carry the
// weight, quadrature says nothing.
constexpr std::size_t k_most = 100;
constexpr double k_least_points = 4;
// Smaller parts of the weights' logarithms: every point counts the same.
constexpr double k_least_part = 1e-6;
// Each time over a variance as much larger than what the time before found, lest it miss tails.
constexpr double k_wider = 1.3;

// Equally likely points of a standard normal (Sobol 1967), one a column. In each dimension every
// one lies in a cell of its own, in its middle.
Eigen::MatrixXd normal_points(Eigen::Index dimensions) {
    std::array<double, k_points> quantile;
    for (int cell = 0; cell < k_points; ++cell) {
        quantile[std::size_t(cell)] =
            -std::numbers::sqrt2 * boost::math::erfc_inv((2 * cell + 1) / double(k_points));
    }
    boost::random::sobol sequence(static_cast<std::size_t>(dimensions));
    constexpr std::uint64_t k_cell = std::numeric_limits<std::uint64_t>::max() / k_points + 1;
    Eigen::MatrixXd points(dimensions, k_points);
    for (double& at : points.reshaped()) at = quantile[sequence() / k_cell];
    return points;
}

double beyond(const std::vector<double>& levels, const double* moved) {
    double most = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) most = std::max(most, levels[i] + moved[i]);
    return most;
}

// By how much chi-square is more than the linear model's, with these errors one after another.
double more_than_linear(const std::vector<CaliperErrors>& calipers, const double* errors) {
    double sum = 0;
    for (const CaliperErrors& c : calipers) {
        const double residual = c.residual + *errors++;
        double out = 0;
        for (const std::vector<double>& levels : c.levels) {
            out += beyond(levels, errors);
            errors += levels.size();
        }
        sum += out * (2 * residual + out);
    }
    return sum;
}

// The readings between two jaws at the same place are one: squares of (residual + out / sigma) add
// up to one such square and what does not change.
struct Between {
    const Equation* caliper = nullptr;
    const Reading* reading = nullptr;
    double weight = 0, pull = 0;  // sums of 1 / sigma^2, of residual / sigma
    FunctionRow row;              // of pull

    bool is_same(const Equation& e, const Reading& r) const {
        return e.caliper == caliper->caliper &&
               (r.kind == ReadingKind::table_width) == (reading->kind == ReadingKind::table_width);
    }
};

std::vector<Between> all_between_jaws(const System& system, const Linearised& linear) {
    std::vector<Between> all;
    for (std::size_t i = 0; i < linear.soft.size(); ++i) {
        const Equation& e = linear.soft[i];
        if (e.caliper == Vec3{0, 0, 0} || !e.is_counted()) continue;
        const Reading& reading = system.readings()[std::size_t(e.reading)];
        auto same = std::find_if(all.begin(), all.end(),
                                 [&](const Between& b) { return b.is_same(e, reading); });
        if (same == all.end()) {
            same = all.insert(all.end(), Between{&e, &reading, 0, 0, {}});
            same->row.resize(linear.layout.size());
        }
        same->weight += 1 / (e.sigma * e.sigma);
        same->pull += linear.soft_residuals(Eigen::Index(i)) / e.sigma;
        same->row += FunctionRow(linear.soft_rows.row(Eigen::Index(i)).transpose()) / e.sigma;
    }
    return all;
}

}  // namespace

Eigen::MatrixXd moments_between_jaws(const std::vector<CaliperErrors>& calipers,
                                     const Eigen::MatrixXd& slopes, const Eigen::VectorXd& mean) {
    const Eigen::Index count = slopes.cols();
    const Eigen::MatrixXd normal = normal_points(count);
    // Points are drawn where the linear model says, then where those of most weight lie (importance
    // sampling; Oh & Berger 1992). Where few carry all the weight, a part of its logarithm tells
    // where to draw next, until all of it can (Neal 2001).
    Eigen::VectorXd middle = mean;
    Eigen::MatrixXd spread = Eigen::MatrixXd::Identity(count, count);
    for (int round = 0; round < k_most_rounds; ++round) {
        const Eigen::MatrixXd root = spread.llt().matrixL();
        const Eigen::MatrixXd points = (root * normal).colwise() + middle;
        const Eigen::MatrixXd errors = slopes * points;
        Eigen::RowVectorXd logs =
            normal.colwise().squaredNorm() - (points.colwise() - mean).colwise().squaredNorm();
        for (Eigen::Index p = 0; p < points.cols(); ++p) {
            logs(p) -= more_than_linear(calipers, errors.col(p).data());
        }
        logs = 0.5 * (logs.array() - logs.maxCoeff());
        Eigen::RowVectorXd weights;
        double part = 1;
        for (; part > k_least_part; part /= 2) {
            weights = (part * logs).array().exp();
            weights /= weights.sum();
            if (weights.squaredNorm() * k_least_points * double(count) < 1) break;
        }
        const Eigen::MatrixXd weighted = points * weights.asDiagonal() * points.transpose();
        if (round > 0 && part == 1) {
            // The difference from what the same points say of the spread that they were drawn from
            // is more exact than either.
            const Eigen::MatrixXd moments =
                spread + middle * middle.transpose() +
                (weighted - points * points.transpose() / double(k_points));
            return Eigen::LLT<Eigen::MatrixXd>(moments).info() == Eigen::Success ? moments
                                                                                 : weighted;
        }
        middle = points * weights.transpose();
        spread = k_wider * (weighted - middle * middle.transpose());
        spread.diagonal().array() += k_least * k_least;
    }
    return Eigen::MatrixXd::Identity(count, count);
}

FlushJaws::FlushJaws(const System& system, const Shape& shape, const Outline& outline,
                     const Linearised& linear, const Covariance& covariance) {
    // Planes that miss their meets have no corner there that a jaw could touch.
    if (system.splits()) return;
    const RowWriter writer(shape);
    std::vector<CaliperErrors> calipers;
    std::vector<FunctionRow> rows;
    std::vector<Eigen::Index> level;  // of `rows`
    for (const Between& between : all_between_jaws(system, linear)) {
        const Equation& e = *between.caliper;
        const double sigma = 1 / std::sqrt(between.weight);
        CaliperErrors errors{between.pull * sigma, {}};
        const std::size_t first = rows.size();
        rows.push_back(between.row * sigma);
        const std::vector<Corner> corners = system.corners_between_jaws(*between.reading, outline);
        for (int jaw = 0; jaw < 2; ++jaw) {
            const Vec3 out = jaw == 0 ? e.caliper : -e.caliper;
            const Corner& touched = e.touched[std::size_t(jaw)];
            const double top = glm::dot(out, place_of(shape, touched));
            for (const Corner& corner : corners) {
                if (glm::dot(out, place_of(shape, corner)) < top - k_far_below) continue;
                const Quantity q = extent(corner, touched, out)(shape);
                FunctionRow row = writer.function(q);
                const double known = std::sqrt(covariance.variance(row));
                if (!(q.value > -k_farthest * known) ||
                    !(q.value + k_farthest * known > k_least * sigma)) {
                    continue;
                }
                if (q.value > -k_level * known) level.push_back(Eigen::Index(rows.size()));
                errors.levels[std::size_t(jaw)].push_back(q.value / sigma);
                rows.push_back(row / sigma);
            }
        }
        if (rows.size() == first + 1) {
            rows.pop_back();
        } else {
            calipers.push_back(std::move(errors));
        }
    }
    if (calipers.empty() || rows.size() > k_most) return;
    const auto count = static_cast<Eigen::Index>(rows.size());
    Eigen::MatrixXd moved(linear.layout.size(), count);
    for (Eigen::Index k = 0; k < count; ++k) {
        moved.col(k) = covariance.with_all(rows[std::size_t(k)], false);
    }
    Eigen::MatrixXd spread(count, count);
    for (Eigen::Index k = 0; k < count; ++k) {
        for (Eigen::Index j = 0; j <= k; ++j) {
            spread(j, k) = spread(k, j) = rows[std::size_t(j)].dot(moved.col(k));
        }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(spread);
    const Eigen::Index independent = (eigen.eigenvalues().array() > k_least * k_least).count();
    if (independent == 0) return;
    const Eigen::MatrixXd axes = eigen.eigenvectors().rightCols(independent);
    const Eigen::VectorXd lengths = eigen.eigenvalues().tail(independent).cwiseSqrt();
    // Where the fit rests on a kink, the linear model's own end lies beyond it: as far as what
    // keeps it there, the corners that are level.
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(independent);
    if (!level.empty()) {
        const Eigen::VectorXd step =
            -moved.transpose() * (linear.soft_rows.transpose() * linear.soft_residuals);
        const Eigen::MatrixXd of_level = spread(Eigen::all, level);
        const Eigen::VectorXd kept =
            of_level(level, Eigen::all).completeOrthogonalDecomposition().solve(step(level));
        mean = lengths.cwiseInverse().asDiagonal() * axes.transpose() * (of_level * kept);
    }
    with_unknowns_ = moved * axes * lengths.cwiseInverse().asDiagonal();
    more_ = moments_between_jaws(calipers, axes * lengths.asDiagonal(), mean);
    more_.diagonal().array() -= 1;
    if (!more_.allFinite() || !with_unknowns_.allFinite()) more_.resize(0, 0);
}

double FlushJaws::more_variance(const FunctionRow& function) const {
    if (more_.size() == 0) return 0;
    Eigen::RowVectorXd along = Eigen::RowVectorXd::Zero(with_unknowns_.cols());
    for (FunctionRow::InnerIterator it(function); it; ++it) {
        along += it.value() * with_unknowns_.row(it.index());
    }
    return along * more_ * along.transpose();
}

}  // namespace culet
