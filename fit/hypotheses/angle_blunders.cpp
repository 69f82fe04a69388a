#include "fit/hypotheses/angle_blunders.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "fit/findings/blunder.h"
#include "fit/findings/fitted_parts.h"
#include "stone/units.h"
#include "stone/upper_median.h"

namespace culet {

namespace {

constexpr double k_times_median = 6, k_least_deg = 10;
// What the others leave of such an error.
constexpr double k_still_deg = 5;

bool is_plain_angle(const Reading& r) {
    return (r.kind == ReadingKind::inclination || r.kind == ReadingKind::azimuth) &&
           r.aggregate == Aggregate::single && r.facets.size() == 1 &&
           r.datum.kind == Datum::Kind::up && !r.exact;
}

double wrapped(double angle) {
    return std::remainder(angle, 2 * std::numbers::pi);
}

// What a fit says of a reading, and how surely.
struct Estimate {
    double value = 0, sigma = 0;
};

Estimate estimate_of(const FitResult& result, const Reading& r) {
    const FittedFacet& facet = result.facets[std::size_t(r.facets[0])];
    if (r.kind == ReadingKind::inclination) return {facet.inclination, facet.sigma_inclination};
    // From 0 to 360 degrees, or on either side of 0, as readings are written.
    double azimuth = wrapped(facet.azimuth - result.azimuth_zero);
    if (azimuth < 0 && r.value >= 0) azimuth += 2 * std::numbers::pi;
    return {azimuth, facet.sigma_azimuth};
}

// Indices of those of `all` that are not among `some`, which has the same order.
std::vector<std::size_t> missing_from(const std::vector<Reading>& some,
                                      const std::vector<Reading>& all) {
    std::vector<std::size_t> missing;
    for (std::size_t i = 0, k = 0; i < all.size(); ++i) {
        if (k < some.size() && some[k].id == all[i].id) {
            ++k;
        } else {
            missing.push_back(i);
        }
    }
    return missing;
}

// The narrow width of each facet of the mesh.
std::vector<double> facet_sizes(const System& system) {
    const Solid mesh = system.met_solid(system.mesh_shape());
    std::vector<double> sizes;
    for (const Facet& facet : mesh.facets) sizes.push_back(narrow_width(mesh, facet));
    return sizes;
}

// A fit with this result would do better without them: it found no stone, or its readings disagree
// and more than one is named, or another than these first.
bool may_be_bent(const FitResult& result, const std::vector<Reading>& readings,
                 const std::vector<std::size_t>& far) {
    if (far.empty()) return false;
    if (result.status == FitStatus::not_converged) return true;
    if (result.status != FitStatus::contradictory) return false;
    if (result.findings.suspects.size() != 1) return true;
    return std::none_of(far.begin(), far.end(), [&](std::size_t i) {
        return readings[i].id == result.findings.suspects.front();
    });
}

// Which of them the result of a fit without them contradicts beyond its suspect limit, and by five
// degrees.
std::vector<std::size_t> contradicted_angles(const FitResult& without,
                                             const std::vector<Reading>& readings,
                                             const std::vector<std::size_t>& far) {
    std::vector<std::size_t> wrong;
    for (const std::size_t i : far) {
        const Estimate e = estimate_of(without, readings[i]);
        const double apart = readings[i].kind == ReadingKind::azimuth
                                 ? std::abs(wrapped(e.value - readings[i].value))
                                 : std::abs(e.value - readings[i].value);
        const double limit = std::max(4.0, without.statistics.suspect_limit) *
                             std::hypot(e.sigma, readings[i].sigma);
        if (apart > std::max(limit, radians(k_still_deg))) {
            wrong.push_back(i);
        }
    }
    return wrong;
}

// The result of a fit without these angles with them in their places again, accused.
void put_back_blunders(const std::vector<Reading>& readings,
                       const std::vector<std::size_t>& blunders, FitResult& result) {
    std::vector<Blunder> all;
    for (const std::size_t i : blunders) {
        result.readings.insert(result.readings.begin() + std::ptrdiff_t(i), as_taken(readings[i]));
        const Estimate e = estimate_of(result, readings[i]);
        all.push_back({i, e.value, e.sigma});
    }
    flag_blunders(readings, all, result);
}

}  // namespace

std::vector<std::size_t> angles_far_from_mesh(const System& system) {
    const Shape& mesh = system.mesh_shape();
    // A rough mesh's small facets are turned further than its large ones.
    const std::vector<double> sizes = facet_sizes(system);
    const double usual = upper_median(sizes);
    std::vector<std::pair<double, std::size_t>> off;
    for (std::size_t i = 0; i < system.readings().size(); ++i) {
        const Reading& r = system.readings()[i];
        if (!is_plain_angle(r)) continue;
        const Vec3& n = mesh.normals[std::size_t(r.facets[0])];
        const double flat = std::hypot(n.x, n.y);
        const double d = r.kind == ReadingKind::inclination
                             ? std::atan2(flat, std::abs(n.z)) - r.value
                             : flat * wrapped(std::atan2(n.y, n.x) - r.value);
        const double share = std::min(1.0, sizes[std::size_t(r.facets[0])] / usual);
        off.emplace_back(std::abs(d) * share, i);
    }
    std::vector<std::size_t> far;
    if (off.size() < 10) return far;
    std::sort(off.begin(), off.end(), std::greater<>());
    const double limit = std::max(k_times_median * off[off.size() / 2].first, radians(k_least_deg));
    for (const auto& [d, i] : off) {
        if (d > limit) far.push_back(i);
    }
    if (far.size() > off.size() / 10) far.clear();
    std::sort(far.begin(), far.end());
    return far;
}

std::optional<Problem> without_far_angles(const Problem& given, const Attempt& first) {
    if (!may_be_bent(first.result, given.readings, first.far_from_mesh)) return std::nullopt;
    Problem changed = with_few_starts(given, first);
    changed.readings = without(given.readings, first.far_from_mesh);
    return changed;
}

Verdict judge_far_angles(const Problem& given, const Attempt& first, const Problem& changed,
                         FitResult again) {
    if (again.status == FitStatus::not_converged) return {};
    const bool any_will_do = first.result.status == FitStatus::not_converged;
    const std::vector<std::size_t> left_out = missing_from(changed.readings, given.readings);
    if (left_out.empty()) {
        // All are back, and the fit went on from where it ended without them.
        if (any_will_do || again.statistics.chi2 < first.result.statistics.chi2)
            return {std::move(again), std::nullopt};
        return {};
    }
    const std::vector<std::size_t> wrong = contradicted_angles(again, given.readings, left_out);
    if (wrong.size() == left_out.size()) {
        // What explains a contradiction takes most of chi-square with it.
        if (!any_will_do && !(again.statistics.chi2 < 0.5 * first.result.statistics.chi2))
            return {};
        put_back_blunders(given.readings, left_out, again);
        return {std::move(again), std::nullopt};
    }
    Problem next = changed;
    next.readings = without(given.readings, wrong);
    if (wrong.empty()) next.options.start = again.solid;
    return {std::nullopt, std::move(next)};
}

}  // namespace culet
