#include "render/grade/grade_sigma.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/grade/curve_sums.h"
#include "render/grade/grade_figures.h"
#include "render/work/threads.h"
#include "stone/design/tiers.h"
#include "stone/stone.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr double k_least_cost = 0.005;  // per cent of light return
// Largest azimuth error of facets that count as evenly spaced around the stone.
constexpr double k_even = 3 * std::numbers::pi / 180;

}  // namespace

GradeSigma grade_sigma(const Solid& solid, const GradeIndex& index, const GradeOptions& options,
                       const StoneUncertainty& uncertainty, int draws, const Progress& progress) {
    check(draws >= 2, "a standard deviation needs two draws");
    GradeOptions quick = options;
    const std::vector<std::size_t> tilts = drawn_tilts(options.tilts.size());
    quick.tilts.clear();
    for (const std::size_t i : tilts) quick.tilts.push_back(options.tilts[i]);
    quick.coarse = true;
    StoneDraws stones(solid, uncertainty, options.seed);
    GradeSigma result;
    result.correlated = uncertainty.correlated();
    std::map<std::string, Running> sums;
    CurveSums curves(options.tilt_axes.size(), tilts.size());
    for (int draw = 0; draw < draws; ++draw) {
        if (progress && !progress(static_cast<double>(draw) / draws)) throw Interrupted();
        const std::optional<Solid> stone = stones.next();
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

// Evens out a tier: mean inclination and distance and, if the facets are evenly spaced around the
// stone, even azimuths.
std::vector<FacetAttitude> even_tier(const std::vector<FacetAttitude>& all,
                                     const std::vector<int>& facets) {
    std::vector<FacetAttitude> tier;
    double inclination = 0, offset = 0;
    for (const int f : facets) {
        tier.push_back(all[static_cast<std::size_t>(f)]);
        inclination += tier.back().inclination / static_cast<double>(facets.size());
        offset += tier.back().offset / static_cast<double>(facets.size());
    }
    const double step = 2 * std::numbers::pi / static_cast<double>(facets.size());
    // Common phase of all facets: circular mean of the azimuths modulo the step.
    double x = 0, y = 0;
    for (const FacetAttitude& a : tier) {
        x += std::cos(a.azimuth * static_cast<double>(facets.size()));
        y += std::sin(a.azimuth * static_cast<double>(facets.size()));
    }
    const double phase = std::atan2(y, x) / static_cast<double>(facets.size());
    bool even = true;
    std::vector<double> places;
    for (const FacetAttitude& a : tier) {
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
    const std::vector<FacetAttitude> as_is = attitudes_of(solid, middle);
    const RandomSky sky(options.seed, index.n);
    const double now = iso_return(solid, index, options, sky);
    struct Trial {
        int facet = 0;
        FacetAttitude even;
        double cost = 0;
    };
    std::vector<Trial> trials;
    for (const FacetTier& tier : tiers_of(solid, {0, 0, 1})) {
        if (tier.facets.size() < 2 || tier.part == StonePart::girdle) continue;
        const std::vector<FacetAttitude> even = even_tier(as_is, tier.facets);
        for (std::size_t i = 0; i < tier.facets.size(); ++i)
            trials.push_back({tier.facets[i], even[i], 0});
    }
    on_threads(options.threads, [&] {
        tbb::parallel_for(std::size_t{0}, trials.size(), [&](std::size_t i) {
            std::vector<FacetAttitude> changed = as_is;
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
