#include "fit/findings/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "fit/findings/meet_tests.h"
#include "fit/findings/name_list.h"
#include "fit/findings/own_axis.h"
#include "fit/findings/shape_findings.h"
#include "fit/findings/symmetry_tests.h"
#include "fit/uncertainty/covariance.h"
#include "fit/uncertainty/statistics.h"

namespace culet {

const char* name_of(ShapeFinding::Kind kind) {
    switch (kind) {
        case ShapeFinding::Kind::edge_vanishes:
            return "edge_vanishes";
        case ShapeFinding::Kind::facet_vanishes:
            return "facet_vanishes";
        case ShapeFinding::Kind::edge_open:
            return "edge_open";
        case ShapeFinding::Kind::facet_open:
            return "facet_open";
    }
    return "edge_open";
}

namespace {

// A length as people say it: micrometres when it is small and the unit is known to be larger.
std::string length_text(double value, LengthUnit unit) {
    const double micrometres = value * mm_per(unit) * 1000;
    if (std::abs(micrometres) < 1000) return fmt::format("{:.2g} um", micrometres);
    return fmt::format("{:.3g} {}", value, name_of(unit));
}

void describe_axis(const System& system, const Shape& shape, const System::Pose& pose,
                   const Covariance* covariance, FitResult& result) {
    const AxisGroup group = form_group(system, shape);
    std::vector<Tier> tiers = tiers_of(system, shape, group);
    AxisEstimate estimate = own_axis(system, shape, tiers, covariance);
    OwnAxis axis = estimate.axis;
    const Vec3 inside = axis.direction;
    constexpr double k_none = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t f = 0; f < result.facets.size(); ++f) {
        const Vec3& n = shape.normals[f];
        result.facets[f].inclination_own_axis = axis.known ? inclination(n, inside) : k_none;
    }
    for (Tier& tier : tiers) {
        double low = 1e9, high = -1e9, own_low = 1e9, own_high = -1e9, squares = 0;
        const double count = double(tier.facets.size());
        for (int f : tier.facets) {
            const FittedFacet& facet = result.facets[std::size_t(f)];
            tier.mean += facet.inclination / count;
            tier.mean_own_axis += facet.inclination_own_axis / count;
            low = std::min(low, facet.inclination);
            high = std::max(high, facet.inclination);
            if (!axis.known) continue;
            own_low = std::min(own_low, facet.inclination_own_axis);
            own_high = std::max(own_high, facet.inclination_own_axis);
        }
        tier.spread = high - low;
        tier.spread_own_axis = axis.known ? own_high - own_low : k_none;
        for (int f : tier.facets) {
            const double d =
                result.facets[std::size_t(f)].inclination_own_axis - tier.mean_own_axis;
            squares += d * d;
        }
        tier.rms_own_axis = std::sqrt(squares / std::max(1.0, count - 1));
        result.findings.tiers.push_back(std::move(tier));
    }
    if (axis.known) {
        // Directions go outside as normals of planes do.
        axis.direction = system.outside_plane({inside, 0}, pose).normal;
        const double flat = std::hypot(inside.x, inside.y);
        axis.azimuth =
            flat > 1e-12
                ? azimuth(Vec3{std::cos(pose.turn) * inside.x - std::sin(pose.turn) * inside.y,
                               std::sin(pose.turn) * inside.x + std::cos(pose.turn) * inside.y, 0})
                : 0;
    }
    result.findings.own_axis = std::move(axis);
}

void describe_meets(const System& system, const Shape& shape, const Covariance& covariance,
                    FitResult& result) {
    MeetTestOptions options;
    options.significance = result.log.options.significance;
    // When a few wrong readings explain the contradiction, they are the simpler story; when they
    // leave it, they are none.
    double explained = 0, largest = 0;
    for (const FittedReading& r : result.readings) {
        if (!r.suspect || !std::isfinite(r.normalized) || is_relation(r.kind)) continue;
        explained += r.normalized * r.normalized;
        largest = std::max(largest, r.normalized * r.normalized);
    }
    if (result.findings.suspects.size() <= 3 &&
        result.statistics.chi2 - explained < result.statistics.chi2_limit) {
        options.least_chi2 = largest;
    }
    result.findings.meets = test_meets(system, shape, covariance, options);
    for (MeetFinding& meet : result.findings.meets) {
        meet.miss *= system.scale();
        meet.sigma *= system.scale();
        const std::string planes = name_list(meet.facets);
        if (meet.contradicted) {
            meet.advice = fmt::format(
                "meet of {}: planes miss by {}, sigma {}: {}", planes,
                length_text(meet.miss, result.unit), length_text(meet.sigma, result.unit),
                meet.how == "exact" ? "release it" : "release it, or give it a larger sigma");
        } else if (meet.how == "released" && meet.tested > 0 && meet.p > 0.05) {
            meet.advice = fmt::format(
                "meet of {}: planes miss by {}, sigma {}: the readings do not tell "
                "this from a common point",
                planes, length_text(meet.miss, result.unit), length_text(meet.sigma, result.unit));
        }
    }
}

void describe_shape(const System& system, const Finished& finished,
                    const std::vector<ActiveCorner>& held, const Diagnosis& diagnosis,
                    const Covariance& holding, FitResult& result) {
    result.findings.shapes = find_open_shape(system, finished, held, diagnosis, holding);
    // A facet that is shut at no loss may as well be there.
    const bool denied = result.findings.vanishing_edges.empty() ||
                        chi2_tail(result.findings.vanishing_chi2,
                                  static_cast<double>(result.findings.vanishing_edges.size())) <
                            result.log.options.significance;
    result.findings.vanishing_edges.clear();
    for (const ShapeFinding& finding : result.findings.shapes) {
        if (finding.kind != ShapeFinding::Kind::edge_vanishes) continue;
        result.findings.vanishing_edges.push_back(finding.facets[0] + "/" + finding.facets[1]);
    }
    for (ShapeFinding& finding : result.findings.shapes) {
        if (denied || finding.kind != ShapeFinding::Kind::facet_vanishes) continue;
        finding.kind = ShapeFinding::Kind::facet_open;
        finding.value = 0;
        const int facet = find_facet(system.stone().solid, finding.facets[0]);
        finding.sigma = diagnosis.facets[static_cast<std::size_t>(facet)].area;
    }
    for (ShapeFinding& finding : result.findings.shapes) {
        const std::string first = finding.facets[0];
        const std::string ends =
            finding.facets.size() > 2
                ? fmt::format(" (between {})",
                              name_list(std::vector<std::string>(finding.facets.begin() + 2,
                                                                 finding.facets.end())))
                : "";
        switch (finding.kind) {
            case ShapeFinding::Kind::edge_vanishes:
                finding.value *= system.scale();
                finding.sigma *= system.scale();
                finding.what = fmt::format(
                    "the readings want edge {}|{}{} to be {} long, sigma {}: it is held at zero",
                    first, finding.facets[1], ends, length_text(finding.value, result.unit),
                    length_text(finding.sigma, result.unit));
                break;
            case ShapeFinding::Kind::facet_vanishes:
                finding.what = fmt::format("the readings leave no room for facet {}", first);
                break;
            case ShapeFinding::Kind::edge_open:
                finding.value *= system.scale();
                finding.sigma *= system.scale();
                finding.what = fmt::format(
                    "edge {}|{}{} is {} long, sigma {}: the readings do not tell on which side of "
                    "zero",
                    first, finding.facets[1], ends, length_text(finding.value, result.unit),
                    length_text(finding.sigma, result.unit));
                break;
            case ShapeFinding::Kind::facet_open:
                finding.value *= system.scale() * system.scale();
                finding.sigma *= system.scale() * system.scale();
                finding.what = fmt::format(
                    "facet {} has an area of {:.2g} {}2, sigma {:.2g}: it may not be there", first,
                    finding.value, name_of(result.unit), finding.sigma);
                break;
        }
    }
}

// Held corners as exact equations, as they lie; of an edge that is held at both ends one, since the
// other says the same.
std::vector<Equation> conditions_of(const System& system, const Shape& shape,
                                    const std::vector<ActiveCorner>& held) {
    std::vector<Equation> conditions;
    for (auto at = held.begin(); at != held.end(); ++at) {
        const ActiveCorner& corner = *at;
        if (std::any_of(held.begin(), at, [&](const ActiveCorner& other) {
                return are_ends_of_one_edge(system, other, corner);
            })) {
            continue;
        }
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

void describe_findings(const System& system, const Finished& finished,
                       const std::vector<ActiveCorner>& held, const Diagnosis& diagnosis,
                       const System::Pose& pose, FitResult& result) {
    if (!result.log.options.findings || !finished.outline) return;
    std::shared_ptr<const Covariance> covariance = diagnosis.covariance;
    if (covariance && !held.empty()) {
        covariance = std::make_shared<const Covariance>(linearise(
            system, finished.shape, finished.outline, conditions_of(system, finished.shape, held)));
    }
    if (covariance && !covariance->usable()) covariance = nullptr;
    describe_axis(system, finished.shape, pose, covariance.get(), result);
    if (!covariance) return;
    describe_meets(system, finished.shape, *covariance, result);
    describe_shape(system, finished, held, diagnosis, *covariance, result);
    const bool declared =
        std::any_of(system.readings().begin(), system.readings().end(), declares_whole_symmetry);
    // Declared symmetry would only be found again: `fit_stone` asks a fit without it.
    if (result.log.options.find_symmetry && !declared) {
        result.findings.symmetry =
            symmetry_of(system, finished.shape, *covariance, result.log.options);
    }
}

}  // namespace culet
