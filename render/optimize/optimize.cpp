#include "render/optimize/optimize.h"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "render/optimize/largest_inside.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Parts of all evaluations: for GemRay's search, and for a search from the design itself. The rest
// is two restarts from the best so far, so that the second escapes a kink where the first stalled.
constexpr double k_two_factors = 0.2, k_own_start = 0.35, k_first_rest = 0.25;
constexpr double k_factor_step = 0.04, k_most_factor = 1.5;
constexpr double k_first_step = 1.5, k_second_step = 0.5;  // degrees
constexpr double k_enough_deg = 0.002;
// Penalties: breaking a limit is worse than any valid cut, and the excess guides the search back.
constexpr double k_broken = 1e3, k_impossible = 1e6;

class Search {
public:
    Search(const TierDesign& design, const Solid& stone, const OptimizeOptions& options,
           const Progress& progress)
        : design_(design),
          stone_(stone),
          options_(options),
          progress_(progress),
          start_volume_(volume(design.start())),
          best_(design.tiers().size(), 0) {
        at_start_ = merit_of(design.start(), options.merit);
        best_score_ = score_of(design.start(), at_start_);
        best_merit_ = at_start_;
    }

    void two_factors() {
        std::vector<double> factors{1, 1};
        by_two_factors_ = at_start_;
        run(NLOPT_LN_NELDERMEAD, factors, 1 / k_most_factor, k_most_factor, k_factor_step,
            share(k_two_factors), [&](const std::vector<double>& x) { return scaled(x); });
        by_two_factors_ = best_merit_;
    }

    void all_tiers(const std::vector<double>& from, double step_deg, int most) {
        std::vector<double> x = from;
        run(NLOPT_LN_SBPLX, x, -degrees(options_.limits.range), degrees(options_.limits.range),
            step_deg, most, [&](const std::vector<double>& deg) {
                std::vector<double> steeper(design_.tiers().size());
                for (std::size_t s = 0; s < deg.size(); ++s) {
                    for (const int tier : design_.tied_tiers()[s])
                        steeper[static_cast<std::size_t>(tier)] = radians(deg[s]);
                }
                return steeper;
            });
    }

    int share(double part) const {
        return std::max(10, static_cast<int>(std::lround(part * options_.evaluations)));
    }
    int left() const { return std::max(10, options_.evaluations - evaluations_); }
    int evaluations() const { return evaluations_; }
    // In degrees, for each set of tied tiers.
    std::vector<double> best_deg() const {
        const double range = degrees(options_.limits.range);
        std::vector<double> deg;
        for (const std::vector<int>& tiers : design_.tied_tiers()) {
            const double one = best_[static_cast<std::size_t>(tiers.front())];
            deg.push_back(std::clamp(degrees(one), -range, range));
        }
        return deg;
    }
    const std::vector<double>& best() const { return best_; }
    const Merit& at_start() const { return at_start_; }
    const Merit& best_merit() const { return best_merit_; }
    const Merit& by_two_factors() const { return by_two_factors_; }

private:
    using Steeper = std::function<std::vector<double>(const std::vector<double>&)>;

    // Multiplies the tangents of crown and pavilion angles by a factor each.
    std::vector<double> scaled(const std::vector<double>& factors) const {
        std::vector<double> steeper;
        for (const FacetTier& tier : design_.tiers()) {
            const double angle = mean_angle(design_.start(), tier);
            const double factor = factors[tier.part == StonePart::crown ? 0 : 1];
            steeper.push_back(std::atan(factor * std::tan(angle)) - angle);
        }
        return steeper;
    }

    // Larger is better. A cut that breaks a limit scores below all valid ones, by the excess.
    double score_of(const Solid& solid, const Merit& merit) const {
        if (!options_.recut) return merit.total;
        const double loss = 1 - largest_inside(solid, stone_).volume / volume(stone_);
        if (options_.recut->gain > 0) {
            const double missing = at_start_.total + options_.recut->gain - merit.total;
            return missing > 0 ? -k_broken - missing : -100 * loss;
        }
        const double over = loss - options_.recut->most_loss;
        return over > 0 ? -k_broken - 100 * over : merit.total;
    }

    double broken(const std::vector<double>& steeper, const Solid& solid) const {
        const OptimizeLimits& limits = options_.limits;
        double by = std::max(0.0, limits.least_volume - volume(solid) / start_volume_);
        const double table = table_share(solid), was = table_share(design_.start());
        // A start outside the limits may stay there.
        by += std::max(0.0, std::min(limits.least_table, was) - table) +
              std::max(0.0, table - std::max(limits.most_table, was));
        const double critical = std::asin(1 / options_.merit.index.n) + limits.over_critical;
        for (std::size_t t = 0; t < steeper.size(); ++t) {
            by += std::max(0.0, std::abs(steeper[t]) - limits.range);
            const FacetTier& tier = design_.tiers()[t];
            if (tier.part != StonePart::pavilion) continue;
            const double from = mean_angle(design_.start(), tier);
            if (from >= critical) by += std::max(0.0, critical - mean_angle(solid, tier));
        }
        return by;
    }

    double value_of(const std::vector<double>& steeper) {
        ++evaluations_;
        if (progress_ && !progress_(std::min(1.0, double(evaluations_) / options_.evaluations)))
            throw Interrupted();
        const std::optional<Solid> solid = design_.with(steeper);
        if (!solid) return -k_impossible;
        const double by = broken(steeper, *solid);
        if (by > 1e-12) return -10 * k_broken * (1 + by);
        const Merit merit = merit_of(*solid, options_.merit);
        const double score = score_of(*solid, merit);
        if (score > best_score_) {
            best_score_ = score;
            best_ = steeper;
            best_merit_ = merit;
        }
        return score;
    }

    struct Call {
        Search* search;
        const Steeper* steeper;
        nlopt_opt opt;
        std::exception_ptr error;
    };

    static double call(unsigned count, const double* x, double*, void* data) {
        Call& self = *static_cast<Call*>(data);
        try {
            return self.search->value_of((*self.steeper)(std::vector<double>(x, x + count)));
        } catch (...) {
            // Exceptions must not pass through NLopt's C code.
            self.error = std::current_exception();
            nlopt_force_stop(self.opt);
            return 0;
        }
    }

    void run(nlopt_algorithm algorithm, std::vector<double>& x, double low, double high,
             double step, int most, const Steeper& steeper) {
        const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> opt(
            nlopt_create(algorithm, static_cast<unsigned>(x.size())), &nlopt_destroy);
        Call data{this, &steeper, opt.get(), nullptr};
        nlopt_set_max_objective(opt.get(), &Search::call, &data);
        nlopt_set_lower_bounds1(opt.get(), low);
        nlopt_set_upper_bounds1(opt.get(), high);
        nlopt_set_initial_step1(opt.get(), step);
        nlopt_set_xtol_abs1(opt.get(), k_enough_deg);
        nlopt_set_maxeval(opt.get(), most);
        double value = 0;
        nlopt_optimize(opt.get(), x.data(), &value);
        if (data.error) std::rethrow_exception(data.error);
    }

    const TierDesign& design_;
    const Solid& stone_;
    const OptimizeOptions& options_;
    const Progress& progress_;
    double start_volume_ = 0;
    std::vector<double> best_;
    Merit at_start_, best_merit_, by_two_factors_;
    double best_score_ = 0;
    int evaluations_ = 0;
};

}  // namespace

double table_share(const Solid& solid) {
    const int table = table_facet(solid, {0, 0, 1});
    if (table < 0) return 0;
    Solid flat;
    for (const int c : solid.facets[static_cast<std::size_t>(table)].corners)
        flat.vertices.push_back(solid.vertices[static_cast<std::size_t>(c)]);
    double share = 0;
    for (const Vec3& along : {Vec3{1, 0, 0}, Vec3{0, 1, 0}})
        share += 0.5 * width_along(flat, along) / width_along(solid, along);
    return share;
}

Solid about_its_axis(const Optimized& result) {
    return moved_inside(result.better, {.scale = 1, .shift = -result.axis});
}

Optimized optimize_cut(const Solid& solid, const OptimizeOptions& options,
                       const Progress& progress) {
    const TierDesign design(solid);
    Search search(design, solid, options, progress);
    Optimized result;
    try {
        search.two_factors();
        const std::vector<double> none(design.tied_tiers().size(), 0);
        search.all_tiers(none, k_first_step, search.share(k_own_start));
        search.all_tiers(search.best_deg(), k_first_step, search.share(k_first_rest));
        search.all_tiers(search.best_deg(), k_second_step, search.left());
    } catch (const Interrupted&) {
        result.interrupted = true;
    }
    result.start = design.start();
    result.at_start = search.at_start();
    result.at_better = search.best_merit();
    result.by_two_factors = search.by_two_factors();
    result.evaluations = search.evaluations();
    result.better = *design.with(search.best());
    for (const double steeper : search.best()) result.found = result.found || steeper != 0;
    if (options.recut) {
        const LargestInside inside = largest_inside(result.better, solid);
        result.better = moved_inside(result.better, inside);
        result.axis = inside.shift;
        result.volume_ratio = inside.volume / volume(solid);
        result.gained = result.at_better.total >= result.at_start.total + options.recut->gain;
    } else {
        result.volume_ratio = volume(result.better) / volume(result.start);
    }
    for (const FacetTier& tier : design.tiers())
        result.tiers.push_back(
            {tier, mean_angle(result.start, tier), mean_angle(result.better, tier)});
    return result;
}

}  // namespace culet
