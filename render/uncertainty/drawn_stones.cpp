#include "render/uncertainty/drawn_stones.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "stone/numbers/dense_algebra.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Box and Muller (1958).
double drawn_normal(Random& random) {
    const double u = 1 - random.uniform(), v = random.uniform();
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

// Matrix, row by row, that transforms unit normals to errors of all facets' three parameters.
Eigen::MatrixXd error_spread(const StoneUncertainty& uncertainty) {
    const Eigen::Index size = static_cast<Eigen::Index>(3 * uncertainty.facets.size());
    Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(size, size);
    if (!uncertainty.correlated()) {
        for (std::size_t f = 0; f < uncertainty.facets.size(); ++f) {
            const Eigen::Index at = static_cast<Eigen::Index>(3 * f);
            spread(at, at) = uncertainty.facets[f].inclination;
            spread(at + 1, at + 1) = uncertainty.facets[f].azimuth;
            spread(at + 2, at + 2) = uncertainty.facets[f].offset;
        }
        return spread;
    }
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Map<const Rows> covariance(uncertainty.covariance.data(), size, size);
    // In units of each sigma, so that angles and lengths have equal weight.
    Eigen::VectorXd sigma = covariance.diagonal().cwiseMax(0).cwiseSqrt();
    Eigen::MatrixXd correlation = covariance;
    for (Eigen::Index i = 0; i < size; ++i) {
        for (Eigen::Index j = 0; j < size; ++j) {
            const double scale = sigma(i) * sigma(j);
            correlation(i, j) = scale > 0 ? covariance(i, j) / scale : (i == j ? 1 : 0);
        }
    }
    const SymmetricEigen parts = symmetric_eigen(correlation);
    spread = parts.vectors * parts.values.cwiseMax(0).cwiseSqrt().asDiagonal();
    return sigma.asDiagonal() * spread;
}

double known_or_zero(double sigma) {
    return std::isfinite(sigma) ? sigma : 0;
}

}  // namespace

StoneUncertainty uncertainty_for(const Solid& solid, const std::vector<std::string>& names,
                                 const std::vector<FacetUncertainty>& sigmas,
                                 const std::vector<double>& covariance) {
    const std::size_t size = 3 * names.size();
    check(sigmas.size() == names.size(), "sigmas of every facet");
    check(covariance.empty() || covariance.size() == size * size, "a covariance of all facets");
    StoneUncertainty uncertainty;
    std::vector<std::size_t> rows;  // of the covariance
    for (const Facet& facet : solid.facets) {
        const auto found = std::find(names.begin(), names.end(), facet.name);
        if (found == names.end())
            throw InputError(
                fmt::format("has no facet \"{}\": it is the report of another stone", facet.name));
        const std::size_t at = static_cast<std::size_t>(found - names.begin());
        const FacetUncertainty& sigma = sigmas[at];
        if (!std::isfinite(sigma.inclination) || !std::isfinite(sigma.offset))
            ++uncertainty.unknown;
        uncertainty.facets.push_back({known_or_zero(sigma.inclination),
                                      known_or_zero(sigma.azimuth), known_or_zero(sigma.offset)});
        for (std::size_t k = 0; k < 3; ++k) rows.push_back(3 * at + k);
    }
    if (covariance.empty()) return uncertainty;
    for (const std::size_t i : rows) {
        for (const std::size_t j : rows)
            uncertainty.covariance.push_back(known_or_zero(covariance[i * size + j]));
    }
    return uncertainty;
}

StoneDraws::StoneDraws(const Solid& solid, const StoneUncertainty& uncertainty, std::uint64_t seed)
    : solid_(solid),
      middle_(mean_corner(solid)),
      truth_(attitudes_of(solid, middle_)),
      random_(Random::mixed(seed)) {
    const std::size_t size = 3 * solid.facets.size();
    check(uncertainty.facets.size() == solid.facets.size(), "an uncertainty for every facet");
    check(!uncertainty.correlated() || uncertainty.covariance.size() == size * size,
          "a covariance of every facet with every other");
    const Eigen::MatrixXd spread = error_spread(uncertainty);
    for (Eigen::Index i = 0; i < spread.rows(); ++i) {
        for (Eigen::Index j = 0; j < spread.cols(); ++j) spread_.push_back(spread(i, j));
    }
}

std::optional<Solid> StoneDraws::next() {
    const std::size_t size = 3 * truth_.size();
    std::vector<double> numbers(size);
    for (double& number : numbers) number = drawn_normal(random_);
    const auto error = [&](std::size_t row) {
        double sum = 0;
        for (std::size_t j = 0; j < size; ++j) sum += spread_[row * size + j] * numbers[j];
        return sum;
    };
    std::vector<FacetAttitude> drawn = truth_;
    for (std::size_t f = 0; f < drawn.size(); ++f) {
        drawn[f].inclination += error(3 * f);
        if (drawn[f].inclination > k_level_sine) drawn[f].azimuth += error(3 * f + 1);
        drawn[f].offset += error(3 * f + 2);
    }
    return stone_of(solid_, drawn, middle_);
}

}  // namespace culet
