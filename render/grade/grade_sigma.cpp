#include "render/grade/grade_sigma.h"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/grade/curve_sums.h"
#include "render/grade/grade_figures.h"
#include "render/optics/random.h"
#include "render/work/threads.h"
#include "stone/errors.h"
#include "stone/stone.h"
#include "stone/tiers.h"

namespace culet {

namespace {

constexpr double k_least_cost = 0.005;  // per cent of light return
constexpr double k_no_level = 1e-9;     // of a level facet's normal: it has no azimuth
// Facets stand evenly around the stone when none is off by more.
constexpr double k_even = 3 * std::numbers::pi / 180;

struct Attitude {
    double inclination = 0, azimuth = 0;
    double side = 1;  // -1: looks down
    double offset = 0;
};

Attitude attitude_of(const Plane& plane, const Vec3& middle) {
    const double level = std::hypot(plane.normal.x, plane.normal.y);
    const double side = plane.normal.z < 0 ? -1 : 1;
    return {std::atan2(level, side * plane.normal.z),
            level > k_no_level ? std::atan2(plane.normal.y, plane.normal.x) : 0, side,
            plane.offset - glm::dot(plane.normal, middle)};
}

Plane plane_of(const Attitude& attitude, const Vec3& middle) {
    const double level = std::sin(attitude.inclination);
    const Vec3 normal{level * std::cos(attitude.azimuth), level * std::sin(attitude.azimuth),
                      attitude.side * std::cos(attitude.inclination)};
    return {normal, attitude.offset + glm::dot(normal, middle)};
}

Vec3 mean_corner(const Solid& solid) {
    Vec3 sum(0);
    for (const Vec3& v : solid.vertices) sum += v;
    return sum / static_cast<double>(solid.vertices.size());
}

// Nothing where the planes bound no stone.
std::optional<Solid> stone_of(const Solid& named, const std::vector<Attitude>& attitudes,
                              const Vec3& middle) {
    std::vector<NamedPlane> planes;
    for (std::size_t f = 0; f < attitudes.size(); ++f)
        planes.push_back({named.facets[f].name, plane_of(attitudes[f], middle)});
    HalfSpaceSolid cut = intersect_half_spaces(planes);
    if (!cut.bounded || cut.empty) return std::nullopt;
    return std::move(cut.solid);
}

std::vector<Attitude> attitudes_of(const Solid& solid, const Vec3& middle) {
    std::vector<Attitude> attitudes;
    for (const Facet& facet : solid.facets) attitudes.push_back(attitude_of(facet.plane, middle));
    return attitudes;
}

// Box and Muller (1958).
double normal_number(Random& random) {
    const double u = 1 - random.uniform(), v = random.uniform();
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

// Rows that make unit normal numbers into errors of all facets' three parameters.
Eigen::MatrixXd spread_of(const StoneUncertainty& uncertainty) {
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
    // In units of each one's own sigma, so that angles and lengths weigh alike.
    Eigen::VectorXd sigma = covariance.diagonal().cwiseMax(0).cwiseSqrt();
    Eigen::MatrixXd correlation = covariance;
    for (Eigen::Index i = 0; i < size; ++i) {
        for (Eigen::Index j = 0; j < size; ++j) {
            const double scale = sigma(i) * sigma(j);
            correlation(i, j) = scale > 0 ? covariance(i, j) / scale : (i == j ? 1 : 0);
        }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(correlation);
    spread = solver.eigenvectors() *
             solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal().toDenseMatrix();
    return sigma.asDiagonal() * spread;
}

void disturb(std::vector<Attitude>& attitudes, const Eigen::VectorXd& errors) {
    for (std::size_t f = 0; f < attitudes.size(); ++f) {
        const Eigen::Index at = static_cast<Eigen::Index>(3 * f);
        attitudes[f].inclination += errors(at);
        if (attitudes[f].inclination > k_no_level) attitudes[f].azimuth += errors(at + 1);
        attitudes[f].offset += errors(at + 2);
    }
}

}  // namespace

GradeSigma grade_sigma(const Solid& solid, const GradeIndex& index, const GradeOptions& options,
                       const StoneUncertainty& uncertainty, int draws, const Progress& progress) {
    check(draws >= 2, "a standard deviation needs two draws");
    check(uncertainty.facets.size() == solid.facets.size(), "an uncertainty for every facet");
    GradeOptions quick = options;
    const std::vector<std::size_t> tilts = drawn_tilts(options.tilts.size());
    quick.tilts.clear();
    for (const std::size_t i : tilts) quick.tilts.push_back(options.tilts[i]);
    quick.coarse = true;
    const Eigen::MatrixXd spread = spread_of(uncertainty);
    const Vec3 middle = mean_corner(solid);
    const std::vector<Attitude> truth = attitudes_of(solid, middle);
    GradeSigma result;
    result.correlated = uncertainty.correlated();
    std::map<std::string, Running> sums;
    CurveSums curves(options.tilt_axes.size(), tilts.size());
    Random random(Random::mixed(options.seed));
    for (int draw = 0; draw < draws; ++draw) {
        if (progress && !progress(static_cast<double>(draw) / draws)) throw Interrupted();
        Eigen::VectorXd numbers(spread.cols());
        for (Eigen::Index i = 0; i < numbers.size(); ++i) numbers(i) = normal_number(random);
        std::vector<Attitude> drawn = truth;
        disturb(drawn, spread * numbers);
        const std::optional<Solid> stone = stone_of(solid, drawn, middle);
        if (!stone) {
            ++result.left_out;
            continue;
        }
        ++result.draws;
        const Grade grade = grade_convex(*stone, index, quick);
        for (const GradeFigure& figure : figures_of(grade)) sums[figure.name].add(figure.value);
        curves.add(grade.curves);
    }
    for (const auto& [name, sum] : sums) {
        if (sum.count >= 2) result.figures[name] = sum.sigma();
    }
    result.curves = curves.sigmas(options, tilts);
    return result;
}

namespace {

// Where the facets of a tier would stand as one: mean inclination and distance, and, where they
// stand evenly around the stone, even azimuths.
std::vector<Attitude> even_tier(const std::vector<Attitude>& all, const std::vector<int>& facets) {
    std::vector<Attitude> tier;
    double inclination = 0, offset = 0;
    for (const int f : facets) {
        tier.push_back(all[static_cast<std::size_t>(f)]);
        inclination += tier.back().inclination / static_cast<double>(facets.size());
        offset += tier.back().offset / static_cast<double>(facets.size());
    }
    const double step = 2 * std::numbers::pi / static_cast<double>(facets.size());
    // The phase of all facets together: the mean direction of what is left of each azimuth.
    double x = 0, y = 0;
    for (const Attitude& a : tier) {
        x += std::cos(a.azimuth * static_cast<double>(facets.size()));
        y += std::sin(a.azimuth * static_cast<double>(facets.size()));
    }
    const double phase = std::atan2(y, x) / static_cast<double>(facets.size());
    bool even = true;
    std::vector<double> places;
    for (const Attitude& a : tier) {
        places.push_back(phase + step * std::round((a.azimuth - phase) / step));
        even = even && std::abs(places.back() - a.azimuth) < k_even;
    }
    for (std::size_t i = 0; i < tier.size(); ++i) {
        tier[i].inclination = inclination;
        tier[i].offset = offset;
        if (even) tier[i].azimuth = places[i];
    }
    return tier;
}

double iso_return(const Solid& solid, const GradeIndex& index, const GradeOptions& options,
                  const RandomSky& sky) {
    const EyeLight light = EyeLightTracer(solid).trace({0, 0, 1}, index.n);
    return 100 * light_return(light, -1, options.head, sky).whole[0];
}

}  // namespace

std::vector<FacetCost> facet_costs(const Solid& solid, const GradeIndex& index,
                                   const GradeOptions& options) {
    const Vec3 middle = mean_corner(solid);
    const std::vector<Attitude> as_is = attitudes_of(solid, middle);
    const RandomSky sky(options.seed, index.n);
    const double now = iso_return(solid, index, options, sky);
    struct Trial {
        int facet = 0;
        Attitude even;
        double cost = 0;
    };
    std::vector<Trial> trials;
    for (const FacetTier& tier : tiers_of(solid, {0, 0, 1})) {
        if (tier.facets.size() < 2 || tier.part == StonePart::girdle) continue;
        const std::vector<Attitude> even = even_tier(as_is, tier.facets);
        for (std::size_t i = 0; i < tier.facets.size(); ++i)
            trials.push_back({tier.facets[i], even[i], 0});
    }
    on_threads(options.threads, [&] {
        tbb::parallel_for(std::size_t{0}, trials.size(), [&](std::size_t i) {
            std::vector<Attitude> changed = as_is;
            changed[static_cast<std::size_t>(trials[i].facet)] = trials[i].even;
            const std::optional<Solid> stone = stone_of(solid, changed, middle);
            if (stone) trials[i].cost = iso_return(*stone, index, options, sky) - now;
        });
    });
    std::vector<FacetCost> costs;
    for (const Trial& trial : trials) {
        const double own = as_is[static_cast<std::size_t>(trial.facet)].inclination;
        if (trial.cost >= k_least_cost)
            costs.push_back({trial.facet, trial.cost, own - trial.even.inclination});
    }
    std::stable_sort(costs.begin(), costs.end(),
                     [](const FacetCost& a, const FacetCost& b) { return a.cost > b.cost; });
    return costs;
}

}  // namespace culet
