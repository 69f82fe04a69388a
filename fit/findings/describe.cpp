#include "fit/findings/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>

#include "fit/findings/meet_tests.h"
#include "fit/findings/own_axis.h"
#include "fit/findings/shape_findings.h"
#include "fit/findings/symmetry_tests.h"
#include "fit/findings/words.h"
#include "fit/model/equations.h"
#include "fit/uncertainty/covariance.h"

namespace culet {

namespace {

constexpr double k_none = std::numeric_limits<double>::quiet_NaN();

// Mean and largest less least of the facets' angles.
std::pair<double, double> mean_and_spread(const FitResult& result, const Tier& tier,
                                          double FittedFacet::*angle) {
    double sum = 0, least = 1e9, most = -1e9;
    for (const int f : tier.facets) {
        const double value = result.facets[std::size_t(f)].*angle;
        sum += value;
        least = std::min(least, value);
        most = std::max(most, value);
    }
    return {sum / double(tier.facets.size()), most - least};
}

void describe_axis(const FitModel& model, const Shape& shape, const Frame::Pose& pose,
                   const Covariance* covariance, FitResult& result) {
    std::vector<Tier> tiers = tiers_of(model, shape, form_group(model, shape));
    OwnAxis axis = own_axis(model, shape, tiers, covariance).axis;
    for (std::size_t f = 0; f < result.facets.size(); ++f) {
        result.facets[f].inclination_own_axis =
            axis.known ? inclination(shape.normals[f], axis.direction) : k_none;
    }
    for (Tier& tier : tiers) {
        std::tie(tier.mean, tier.spread) = mean_and_spread(result, tier, &FittedFacet::inclination);
        std::tie(tier.mean_own_axis, tier.spread_own_axis) =
            axis.known ? mean_and_spread(result, tier, &FittedFacet::inclination_own_axis)
                       : std::pair(k_none, k_none);
        double squares = 0;
        for (const int f : tier.facets) {
            const double off =
                result.facets[std::size_t(f)].inclination_own_axis - tier.mean_own_axis;
            squares += off * off;
        }
        tier.rms_own_axis = std::sqrt(squares / std::max(1.0, double(tier.facets.size()) - 1));
    }
    if (axis.known) {
        const Vec3 inside = axis.direction;
        // Directions go outside as normals of planes do.
        axis.direction = model.frame().outside_plane({inside, 0}, pose).normal;
        const double leans = std::hypot(inside.x, inside.y), c = std::cos(pose.turn),
                     s = std::sin(pose.turn);
        axis.azimuth =
            leans > 1e-12
                ? azimuth(Vec3{c * inside.x - s * inside.y, s * inside.x + c * inside.y, 0})
                : 0;
    }
    result.findings.tiers = std::move(tiers);
    result.findings.own_axis = std::move(axis);
}

// When a few wrong readings explain the contradiction, they are the simpler story; when they leave
// it, they are none.
double explained_by_readings(const FitResult& result) {
    double explained = 0, largest = 0;
    for (const FittedReading& r : result.readings) {
        if (!r.suspect || !std::isfinite(r.normalized) || is_relation(r.kind)) continue;
        explained += r.normalized * r.normalized;
        largest = std::max(largest, r.normalized * r.normalized);
    }
    const bool are_few = result.findings.suspects.size() <= 3 &&
                         result.statistics.chi2 - explained < result.statistics.chi2_limit;
    return are_few ? largest : 0;
}

void describe_meets(const FitModel& model, const Shape& shape, const Covariance& covariance,
                    FitResult& result) {
    result.findings.meets = test_meets(
        model, shape, covariance, {result.log.options.significance, explained_by_readings(result)});
    for (MeetFinding& meet : result.findings.meets) {
        meet.miss *= model.frame().scale();
        meet.sigma *= model.frame().scale();
        const bool may_meet = meet.how == "released" && meet.tested > 0 && meet.p > 0.05;
        if (!meet.contradicted && !may_meet) continue;
        meet.advice =
            fmt::format("meet of {}: planes miss by {}, sigma {}: {}", name_list(meet.facets),
                        length_words(meet.miss, result.unit), length_words(meet.sigma, result.unit),
                        !meet.contradicted    ? "the readings do not tell this from a common point"
                        : meet.how == "exact" ? "release it"
                                              : "release it, or give it a larger sigma");
    }
}

// Held corners as exact equations, as they lie; of an edge that is held at both ends one, since the
// other says the same.
std::vector<Equation> conditions_of(const FitModel& model, const Shape& shape,
                                    const std::vector<ActiveCorner>& held) {
    std::vector<Equation> conditions;
    for (auto at = held.begin(); at != held.end(); ++at) {
        const ActiveCorner& corner = *at;
        const bool is_said = std::any_of(held.begin(), at, [&](const ActiveCorner& other) {
            return are_ends_of_one_edge(model, other, corner);
        });
        if (is_said) continue;
        Equation e;
        e.role = Equation::Role::relation;
        e.exact = true;
        e.formula = height(corner.facet, Corner{corner.point, {-1, -1, -1}});
        e.value = e.formula(shape).value;
        conditions.push_back(std::move(e));
    }
    return conditions;
}

}  // namespace

void describe_findings(const FitModel& model, const Finished& finished,
                       const std::vector<ActiveCorner>& held, const Diagnosis& diagnosis,
                       const Frame::Pose& pose, FitResult& result) {
    if (!result.log.options.findings || !finished.outline) return;
    std::shared_ptr<const Covariance> covariance = diagnosis.covariance;
    if (covariance && !held.empty()) {
        covariance = std::make_shared<const Covariance>(linearise(
            model, finished.shape, finished.outline, conditions_of(model, finished.shape, held)));
    }
    if (covariance && !covariance->usable()) covariance = nullptr;
    describe_axis(model, finished.shape, pose, covariance.get(), result);
    if (!covariance) return;
    describe_meets(model, finished.shape, *covariance, result);
    FitFindings& findings = result.findings;
    findings.shapes = find_open_shape(model, finished, held, diagnosis, *covariance, result);
    findings.vanishing_edges.clear();
    for (const ShapeFinding& finding : findings.shapes) {
        if (finding.kind != ShapeFinding::Kind::edge_vanishes) continue;
        findings.vanishing_edges.push_back(finding.facets[0] + "/" + finding.facets[1]);
    }
    const bool declared =
        std::any_of(model.readings().begin(), model.readings().end(), declares_whole_symmetry);
    // Declared symmetry would only be found again: `fit_stone` asks a fit without it.
    if (result.log.options.find_symmetry && !declared) {
        findings.symmetry = symmetry_of(model, finished.shape, *covariance, result.log.options);
    }
}

}  // namespace culet
