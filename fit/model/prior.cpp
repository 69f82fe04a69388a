#include "fit/model/prior.h"
#include "fit/model/constants.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <set>

#include "stone/design/tiers.h"
#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

// An inclination as read, minus its start.
struct Seen {
    double off = 0, variance = 0;
};

double mean_seen(const std::vector<Seen>& tier) {
    double sum = 0;
    for (const Seen& seen : tier) sum += seen.off;
    return tier.empty() ? 0 : sum / double(tier.size());
}

PriorSigmas stated_sigmas(const Prior& prior, double half_width) {
    const double facets =
        prior.source == Prior::Source::mesh ? k_prior.facets_of_drawing : k_prior.facets_of_design;
    const double offset = prior.offset_sigma * 2 * half_width;
    return {prior.inclination_sigma, facets * prior.inclination_sigma, offset, facets * offset};
}

// Lever arm of a facet: its tilt is the corners' error over this. Root of half the sum of squared
// distances of the corners from their mean.
double facet_reach(const Shape& shape, const Facet& facet) {
    Vec3 mean(0);
    for (const int c : facet.corners) {
        mean += shape.points[std::size_t(c)] / double(facet.corners.size());
    }
    double squares = 0;
    for (const int c : facet.corners) {
        const Vec3 r = shape.points[std::size_t(c)] - mean;
        squares += glm::dot(r, r);
    }
    return std::sqrt(0.5 * squares);
}

double polar(const Vec3& n) {
    return std::atan2(std::hypot(n.x, n.y), n.z);
}

// Gives each tier that was drawn with nearly one angle its median angle.
void level_tiers(const std::vector<NamedTier>& tiers, double sigma, std::vector<double>& polars) {
    for (const NamedTier& tier : tiers) {
        std::vector<double> angles;
        for (const int f : tier.facets) angles.push_back(polars[std::size_t(f)]);
        const auto [least, most] = std::minmax_element(angles.begin(), angles.end());
        if (*most - *least > k_prior.meant_alike * sigma) continue;
        const double middle = upper_median(angles);
        for (const int f : tier.facets) polars[std::size_t(f)] = middle;
    }
}

}  // namespace

void count_beside_prior(const Shape& shape, const Solid& solid, double meet_miss,
                        const std::function<double(const Reading&)>& unit_of,
                        std::vector<Reading>& readings) {
    std::map<std::pair<std::string, long>, int> count;
    const auto row_of = [](const Reading& r) { return std::pair(r.file.string(), r.line); };
    for (const Reading& r : readings) {
        if (r.line > 0 && r.is_measured()) ++count[row_of(r)];
    }
    for (Reading& r : readings) {
        if (!r.is_measured()) continue;
        if (r.line > 0) r.sigma *= std::sqrt(double(count[row_of(r)]));
        if (r.kind == ReadingKind::volume || r.kind == ReadingKind::weight) continue;
        double miss = meet_miss;
        if (is_angle(r.kind)) {
            miss = meet_miss / facet_reach(shape, solid.facets[std::size_t(r.facets[0])]);
        }
        r.sigma = std::hypot(r.sigma, miss * unit_of(r));
    }
}

void estimate_angle_sigmas(const Solid& solid, const std::vector<Reading>& readings,
                           PriorModel& model) {
    std::map<int, double> start;
    for (const PriorTerm& term : model.terms) {
        if (term.of == PriorTerm::Of::inclination) start[term.facet] = term.start;
    }
    // One reading for each row: a row shared by several facets only tells of their tier.
    std::map<int, Seen> by_facet;
    std::set<std::pair<std::string, long>> rows;
    for (const Reading& r : readings) {
        if (r.kind != ReadingKind::inclination || r.facets.size() != 1 || r.exact ||
            r.datum.kind != Datum::Kind::up || start.count(r.facets[0]) == 0 ||
            (r.line > 0 && !rows.insert({r.file.string(), r.line}).second)) {
            continue;
        }
        by_facet.try_emplace(r.facets[0], Seen{r.value - start[r.facets[0]], r.sigma * r.sigma});
    }
    const auto level = [&](PriorLevel l) -> double& { return model.sigmas[std::size_t(l)]; };
    std::vector<std::vector<Seen>> tiers;
    for (const NamedTier& tier : named_tiers(solid, Vec3{0, 0, 1})) {
        tiers.emplace_back();
        for (const int f : tier.facets) {
            if (by_facet.count(f) > 0) tiers.back().push_back(by_facet[f]);
        }
    }
    double squares = k_prior.facets_count * std::pow(level(PriorLevel::facet_angle), 2);
    double freedom = k_prior.facets_count;
    for (const std::vector<Seen>& tier : tiers) {
        const double mean = mean_seen(tier);
        for (const Seen& seen : tier) {
            squares += std::pow(seen.off - mean, 2) - seen.variance * (1 - 1 / double(tier.size()));
        }
        freedom += std::max(0.0, double(tier.size()) - 1);
    }
    const double least = std::pow(k_prior.least_part * level(PriorLevel::facet_angle), 2);
    const double of_facets = std::max(least, squares / freedom);
    level(PriorLevel::facet_angle) = std::sqrt(of_facets);
    squares = k_prior.tiers_count * std::pow(level(PriorLevel::tier_angle), 2);
    freedom = k_prior.tiers_count;
    for (const std::vector<Seen>& tier : tiers) {
        if (tier.empty()) continue;
        double noise = 0;
        for (const Seen& seen : tier) noise += (of_facets + seen.variance) / double(tier.size());
        squares += std::pow(mean_seen(tier), 2) - noise / double(tier.size());
        ++freedom;
    }
    level(PriorLevel::tier_angle) = std::sqrt(std::max(
        std::pow(k_prior.least_part * level(PriorLevel::tier_angle), 2), squares / freedom));
}

PriorModel make_prior(const Prior& prior, const Solid& solid, int up_facet, double half_width,
                      Shape& shape) {
    PriorModel model;
    model.sigmas = stated_sigmas(prior, half_width);
    model.azimuth_ratio = prior.azimuth_sigma / prior.inclination_sigma;
    const std::vector<NamedTier> tiers = named_tiers(solid, Vec3{0, 0, 1});
    const std::vector<int> tier_of = tier_of_each(tiers, shape.normals.size());
    std::vector<double> polars;
    for (const Vec3& n : shape.normals) polars.push_back(polar(n));
    if (prior.source == Prior::Source::mesh) {
        level_tiers(tiers, prior.inclination_sigma, polars);
    }
    const auto extra = [&] {
        shape.extras.push_back(0);
        return int(shape.extras.size()) - 1;
    };
    for (std::size_t t = 0; t < tiers.size(); ++t) {
        model.angle_extras.push_back(extra());
        model.azimuth_extras.push_back(extra());
        model.offset_extras.push_back(extra());
    }
    for (int f = 0; f < int(shape.normals.size()); ++f) {
        const int tier = tier_of[std::size_t(f)];
        const auto common = [&](const std::vector<int>& extras) {
            return tier < 0 ? -1 : extras[std::size_t(tier)];
        };
        const Vec3& n = shape.normals[std::size_t(f)];
        using Of = PriorTerm::Of;
        const double tilt = polars[std::size_t(f)];
        if (f == up_facet) {
            // Level by the frame.
        } else if (std::min(tilt, std::numbers::pi - tilt) < radians(k_prior.level_deg)) {
            model.terms.push_back({Of::level_x, f, -1, n.x});
            model.terms.push_back({Of::level_y, f, -1, n.y});
        } else {
            const int side = n.z < 0 ? -1 : 1;
            model.terms.push_back({Of::inclination, f, common(model.angle_extras),
                                   side > 0 ? tilt : std::numbers::pi - tilt, side});
            model.terms.push_back(
                {Of::azimuth, f, common(model.azimuth_extras), std::atan2(n.y, n.x)});
        }
        model.terms.push_back(
            {Of::offset, f, common(model.offset_extras), shape.offsets[std::size_t(f)]});
    }
    return model;
}

}  // namespace culet
