#include "fit/findings/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "fit/findings/blunder.h"
#include "fit/findings/cut_quantities.h"
#include "fit/findings/meet_tests.h"
#include "fit/findings/optimal_design.h"
#include "fit/findings/own_axis.h"
#include "fit/findings/shape_findings.h"
#include "fit/findings/symmetry_tests.h"
#include "fit/findings/words.h"
#include "fit/model/equations.h"
#include "fit/uncertainty/covariance.h"
#include "stone/design/tiers.h"

namespace culet {

namespace {

constexpr double k_none = std::numeric_limits<double>::quiet_NaN();

// Mean and range of the facets' angles.
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
        axis.direction = model.frame().outside_plane({inside, 0}, pose).normal;
        axis.azimuth = outside_azimuth(inside, pose);
    }
    result.findings.tiers = std::move(tiers);
    result.findings.own_axis = std::move(axis);
}

// The most chi-square that one suspect explains, if a few explain the contradiction; else 0.
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
    result.findings.meets = test_meets(model, shape, covariance, result.log.options.significance,
                                       explained_by_readings(result));
    for (MeetFinding& meet : result.findings.meets) {
        meet.miss *= model.frame().scale();
        meet.sigma *= model.frame().scale();
        const bool may_meet = meet.how == "released" && meet.tested > 0 && meet.p > 0.05;
        if (!meet.contradicted && !may_meet) continue;
        meet.advice = fmt::format(
            "meet of {}: planes miss by {}: {}", name_list(meet.facets),
            length_words(meet.miss, meet.sigma, result.unit),
            meet.contradicted ? "release it" : "the readings allow a common point here");
    }
}

// Held corners as exact equations at their present heights; one for an edge held at both ends.
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

// One sentence for each tier and kind of parameter.
std::vector<std::string> undetermined_words(const FitModel& model, const Shape& shape,
                                            const std::vector<Undetermined>& undetermined) {
    if (undetermined.empty()) return {};
    const Solid& mesh = model.stone().solid;
    // From the mesh's form, because facet numbers do not tell tiers.
    const std::vector<FacetTier> tiers = culet::tiers_of(mesh, model.stone().up);
    const std::vector<int> tier_of = tier_of_each(tiers, mesh.facets.size());
    std::vector<std::pair<int, std::string>> order;
    std::map<std::pair<int, std::string>, std::vector<std::string>> groups;
    for (const Undetermined& u : undetermined) {
        const auto key = std::make_pair(tier_of[std::size_t(find_facet(mesh, u.facet))], u.freedom);
        if (groups[key].empty()) order.push_back(key);
        groups[key].push_back(u.facet);
    }
    std::vector<std::string> sentences;
    for (const auto& key : order) {
        const std::vector<std::string>& names = groups[key];
        const int first = find_facet(mesh, names[0]);
        const char* s = names.size() > 1 ? "s" : "";
        const bool whole =
            names.size() > 1 && names.size() == tiers[std::size_t(key.first)].facets.size();
        const std::string role = first == model.frame().up_facet()         ? "table"
                                 : model.frame().is_girdle(first)          ? "girdle facet"
                                 : shape.normals[std::size_t(first)].z > 0 ? "crown facet"
                                                                           : "pavilion facet";
        sentences.push_back(fmt::format("nothing measured fixes the {}{} of {}{}{} {}", key.second,
                                        s, whole ? "the " : "", role, s, name_list(names)));
    }
    return sentences;
}

void propose(const FitModel& model, const Diagnosis& diagnosis, FitFindings& findings) {
    const auto reading = [&](int r) -> const Reading& { return model.readings()[std::size_t(r)]; };
    for (const Suspicion& s : diagnosis.suspicions) {
        // The others may be wrong too: a slip must leave little of the error unexplained.
        constexpr double k_part_missed = 0.25;
        Proposal proposal = proposal_for(reading(s.reading), s.estimate, s.sigma, k_part_missed);
        for (const int other : s.alternatives) proposal.alternatives.push_back(reading(other).id);
        findings.proposals.push_back(std::move(proposal));
    }
    for (const int r : diagnosis.disagreeing) findings.disagreeing.push_back(reading(r).id);
}

void describe_whole(const FitModel& model, const Finished& finished, const Diagnosis& diagnosis,
                    FitFindings& findings) {
    const Covariance& covariance = *diagnosis.covariance;
    const RowWriter writer(finished.shape);
    for (const CutQuantity& q : cut_quantities(model, finished.shape, finished.outline)) {
        findings.proportions.push_back(
            {q.name, q.unit, q.quantity.value,
             std::sqrt(covariance.total_variance(writer.function(q.quantity)))});
    }
    findings.undetermined_words = undetermined_words(model, finished.shape, diagnosis.undetermined);
    findings.help = next_readings(model, finished.shape, finished.outline, covariance);
}

}  // namespace

void describe_findings(const FitModel& model, const Finished& finished,
                       const std::vector<ActiveCorner>& held, const Diagnosis& diagnosis,
                       const Frame::Pose& pose, FitResult& result) {
    propose(model, diagnosis, result.findings);
    if (!finished.outline) return;
    if (diagnosis.covariance) describe_whole(model, finished, diagnosis, result.findings);
    if (!result.log.options.findings) return;
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
    const bool declared =
        std::any_of(model.readings().begin(), model.readings().end(), declares_whole_symmetry);
    // A declared symmetry would only be found again: `fit_stone` asks for a fit without it.
    if (result.log.options.find_symmetry && !declared) {
        findings.symmetry = symmetry_of(model, finished.shape, *covariance, result.log.options);
    }
}

}  // namespace culet
