// What is known between the jaws of calipers, against integrals and against drawing.

#include "fit/flush_jaws.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "fit/facet_functions.h"
#include "tests/bench/fit_trials.h"
#include "tests/fit/test_stones.h"

namespace culet {
namespace {

using namespace bench;

// What the quadrature leaves of a sigma: 2 % in the mean of the stones below, and of the worst of
// 40 less than 9 %, measured. Sigmas are told to a tenth of themselves.
constexpr double k_mean_error = 0.03, k_worst_error = 0.12;

// A reading that nothing else says anything of, off by nothing; the other corner stands out by a
// times y. Where y < 0 it is a standard normal, where y > 0 one of variance 1 / (1 + a^2).
TEST(FlushJaws, OneCornerBesideAnotherLevelWithIt) {
    for (const double a : {0.3, 1.0, 4.0}) {
        CaliperErrors errors;
        errors.levels[0] = {0};
        const Eigen::MatrixXd slopes = Eigen::Vector2d(0, a);
        const Eigen::MatrixXd moments =
            moments_between_jaws({errors}, slopes, Eigen::VectorXd::Zero(1));
        const double c = 1 / std::sqrt(1 + a * a);
        EXPECT_NEAR(std::sqrt(moments(0, 0) / ((1 + c * c * c) / (1 + c))), 1, 0.01) << a;
    }
}

TEST(FlushJaws, CornersOutOfReachSayNothing) {
    CaliperErrors errors{0.7, {}};
    errors.levels = {std::vector<double>{-50}, {-80}};
    const Eigen::MatrixXd slopes = (Eigen::MatrixXd(3, 2) << 1, 0, 0, 1, 1, 1).finished();
    const Eigen::MatrixXd moments =
        moments_between_jaws({errors}, slopes, Eigen::VectorXd::Zero(2));
    EXPECT_TRUE(moments.isIdentity(k_mean_error)) << moments;
}

// One jaw on each of many corners beside another, all of them too narrow or too wide by `pull`
// sigmas.
constexpr double k_slope = 5;
Eigen::MatrixXd moments_of_many(int many, double pull) {
    std::vector<CaliperErrors> calipers;
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(2 * many, many);
    for (int i = 0; i < many; ++i) {
        CaliperErrors errors{pull, {}};
        errors.levels[0] = {0};
        calipers.push_back(std::move(errors));
        slopes(2 * i + 1, i) = k_slope;
    }
    return moments_between_jaws(calipers, slopes, Eigen::VectorXd::Zero(many));
}

// Each of six falls as exp(-(y^2 + (5 y - 3)^2) / 2) where y > 0: of points drawn from the linear
// model one in a million lies where the readings say. Expected are sums over a fine grid. The error
// of a second moment by n equally weighty points of a normal is sqrt(2 / n), of its root half that,
// and four points a dimension are asked.
TEST(FlushJaws, DrawnFarFromWhereTheReadingsSay) {
    constexpr double k_pull = -3;
    constexpr int k_many = 6;
    double sum = 0, square = 0;
    for (double y = -9; y < 9; y += 1e-3) {
        const double out = std::max(0.0, k_slope * y);
        const double weight = std::exp(-0.5 * (y * y + out * (2 * k_pull + out)));
        sum += weight;
        square += weight * y * y;
    }
    const double standard_error = std::sqrt(2.0 / (4 * k_many)) / 2;
    const Eigen::MatrixXd moments = moments_of_many(k_many, k_pull);
    for (const double moment : moments.diagonal()) {
        EXPECT_NEAR(std::sqrt(moment / (square / sum)), 1, 2 * standard_error);
    }
}

// Hardly a point of any draw.
TEST(FlushJaws, WhereQuadratureFailsTheLinearModelStands) {
    EXPECT_TRUE(moments_of_many(40, 3).isIdentity());
}

// Against sums over a fine grid of exp(-chi2 / 2), chi2 being written down as it is.
TEST(FlushJaws, MomentsAreThoseOfTheKinkedChiSquare) {
    constexpr unsigned k_seeds = 40;
    double squares = 0;
    for (unsigned seed = 1; seed <= k_seeds; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        std::mt19937_64 random(seed);
        std::normal_distribution<double> normal;
        std::vector<CaliperErrors> calipers;
        for (int i = 0; i < 2; ++i) {
            CaliperErrors errors{normal(random), {}};
            errors.levels[0] = {-std::abs(normal(random)), -std::abs(normal(random))};
            if (i == 0) errors.levels[1] = {-std::abs(normal(random))};
            calipers.push_back(std::move(errors));
        }
        Eigen::MatrixXd slopes(7, 2);
        for (double& s : slopes.reshaped()) s = normal(random);
        // The readings themselves are two of those that leave y a variance of one.
        for (const int reading : {0, 4}) slopes.row(reading) *= 0.6 / slopes.row(reading).norm();
        const Eigen::Vector2d mean(0.3 * normal(random), 0.3 * normal(random));
        const auto chi2_more = [&](const Eigen::VectorXd& e) {
            const double first = calipers[0].residual + e(0), second = calipers[1].residual + e(4);
            const double out_first = std::max({0.0, calipers[0].levels[0][0] + e(1),
                                               calipers[0].levels[0][1] + e(2)}) +
                                     std::max(0.0, calipers[0].levels[1][0] + e(3)),
                         out_second = std::max({0.0, calipers[1].levels[0][0] + e(5),
                                                calipers[1].levels[0][1] + e(6)});
            return std::pow(first + out_first, 2) - first * first +
                   std::pow(second + out_second, 2) - second * second;
        };
        Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
        double weights = 0;
        for (double x = -8; x <= 8; x += 0.05) {
            for (double y = -8; y <= 8; y += 0.05) {
                const Eigen::Vector2d at(x, y);
                const double weight =
                    std::exp(-0.5 * ((at - mean).squaredNorm() + chi2_more(slopes * at)));
                sum += weight * at * at.transpose();
                weights += weight;
            }
        }
        const Eigen::MatrixXd moments = moments_between_jaws(calipers, slopes, mean);
        for (const int k : {0, 1}) {
            const double error = std::sqrt(moments(k, k) / (sum(k, k) / weights)) - 1;
            EXPECT_LT(std::abs(error), k_worst_error) << moments << "\n" << sum / weights;
            squares += 0.5 * error * error / k_seeds;
        }
    }
    EXPECT_LT(std::sqrt(squares), k_mean_error);
}

// A step cut whose sides lie all but flush between the jaws. Stones are drawn from what the linear
// model knows, laid between the jaws, which touch whichever corner stands out farthest, and counted
// as much as the readings then agree.
TEST(FlushJaws, AzimuthsAreAsSureAsOfStonesDrawnAndRead) {
    const Truth truth = make_truth(TruthKind::step, false, 7);
    const std::vector<Reading> readings =
        bind_readings(read_by_instruments(truth, 1003), truth.stone);
    FitOptions options;
    options.findings = false;
    const FitResult fitted = fit_stone(truth.stone, readings, options);
    ASSERT_EQ(fitted.status, FitStatus::converged);
    Stone stone = truth.stone;
    stone.solid = fitted.solid;
    const System system(stone, readings, {});
    const Shape& shape = system.mesh_shape();
    const Linearised linear = linearise(system, shape, system.mesh_outline(), false);
    const Covariance covariance(linear);
    const FlushJaws jaws(system, shape, *system.mesh_outline(), linear, covariance);

    std::vector<FunctionRow> unknowns;
    for (Eigen::Index k = 0; k < linear.layout.size(); ++k) {
        unknowns.emplace_back(linear.layout.size());
        unknowns.back().coeffRef(k) = 1;
    }
    const DenseRows half = *covariance.halves(unknowns);
    std::vector<FunctionRow> azimuths;
    for (int f = 0; f < linear.layout.facets; ++f) {
        if (std::abs(shape.normals[std::size_t(f)].z) > 0.1) continue;
        azimuths.push_back(facet_functions(shape, f, linear.layout, middle_of(shape))[1]);
    }
    ASSERT_EQ(azimuths.size(), 8u);
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    constexpr int k_drawn = 8000;
    Eigen::VectorXd squares = Eigen::VectorXd::Zero(8);
    double weights = 0, weights_squared = 0;
    for (int i = 0; i < k_drawn; ++i) {
        Eigen::VectorXd along(half.cols());
        for (double& a : along) a = normal(random);
        const Eigen::VectorXd step = half * along;
        double more = 0;
        for (std::size_t e = 0; e < linear.soft.size(); ++e) {
            const Equation& reading = linear.soft[e];
            if (reading.caliper == Vec3{0, 0, 0}) continue;
            double high = -1e300, low = 1e300;
            for (std::size_t p = 0; p < shape.points.size(); ++p) {
                const Eigen::Index at = linear.layout.point(int(p));
                const Vec3 place = shape.points[p] + Vec3{step(at), step(at + 1), step(at + 2)};
                high = std::max(high, glm::dot(reading.caliper, place));
                low = std::min(low, glm::dot(reading.caliper, place));
            }
            const double straight = linear.soft_residuals(Eigen::Index(e)) +
                                    linear.soft_rows.row(Eigen::Index(e)).dot(step);
            more += std::pow((high - low - reading.value) / reading.sigma, 2) - straight * straight;
        }
        const double weight = std::exp(-0.5 * more);
        weights += weight;
        weights_squared += weight * weight;
        for (Eigen::Index f = 0; f < 8; ++f) {
            squares(f) += weight * std::pow(azimuths[std::size_t(f)].dot(step), 2);
        }
    }
    // A standard deviation from n draws is off by 1 / sqrt(2 n): here by four times that, and by
    // what the quadrature leaves.
    const double effective = weights * weights / weights_squared;
    const double margin = 4 / std::sqrt(2 * effective) + k_mean_error;
    EXPECT_GT(effective, 500);
    double gain = 1;
    for (Eigen::Index f = 0; f < 8; ++f) {
        const double drawn = std::sqrt(squares(f) / weights),
                     linear_only = covariance.variance(azimuths[std::size_t(f)]),
                     told = std::sqrt(linear_only + jaws.more_variance(azimuths[std::size_t(f)]));
        EXPECT_NEAR(told / drawn, 1, margin) << f;
        gain = std::min(gain, told / std::sqrt(linear_only));
    }
    // The linear model is told apart from it.
    EXPECT_LT(gain, 1 - margin);
}

}  // namespace
}  // namespace culet
