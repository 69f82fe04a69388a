#include "fit/findings/symmetry_tests.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "fit/findings/own_axis.h"
#include "fit/findings/polar_coordinates.h"
#include "fit/uncertainty/condition_tests.h"
#include "fit/uncertainty/statistics.h"
#include "fit/uncertainty/variance_component.h"
#include "stone/numbers/dense_algebra.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

// Above this, dense algebra on three numbers a facet would take minutes.
constexpr std::size_t k_most_facets = 700;
// Variance: the readings determine a condition to half of the half diameter.
constexpr double k_told_variance = 0.25;
// Variance: a condition is exact by other ones.
constexpr double k_exact = 1e-18;
// Part of the conditions that must be tested to make a group determined.
constexpr double k_enough = 0.5;
// A column with a smaller part outside the others repeats them.
constexpr double k_repeats = 1e-6;

// Conditions that symmetry puts on a shape with exact meets: edges less their orbits.
int edge_conditions(const FitModel& model, const AxisGroup& group) {
    std::set<std::pair<int, int>> seen;
    int orbits = 0;
    for (const Edge& e : model.edges().edges) {
        if (seen.count(std::minmax(e.left, e.right)) > 0) continue;
        ++orbits;
        for (const AxisGroup::Element& g : group.elements) {
            seen.insert(std::minmax(g.facets[std::size_t(e.left)], g.facets[std::size_t(e.right)]));
        }
    }
    return static_cast<int>(model.edges().edges.size()) - orbits;
}

// Orthonormal columns for the range of a matrix: at most `most`, with pivots above `least`.
Eigen::MatrixXd range_of(const Eigen::MatrixXd& matrix, double least, Eigen::Index most) {
    if (matrix.size() == 0) return Eigen::MatrixXd(matrix.rows(), 0);
    const PivotedQr qr(matrix);
    most = std::min({most, matrix.rows(), matrix.cols()});
    Eigen::Index rank = 0;
    while (rank < most && qr.pivot(rank) > least) ++rank;
    return qr.first(rank);
}

// What is known of the planes: coordinates (polar_coordinates.h), their covariance, and what meets
// leave free, whatever was read (`reach_of`).
struct Told {
    PolarCoordinates coordinates;
    Eigen::MatrixXd covariance, reach;
};

// Chi-square of the deviations from the group's symmetry, for the best placement.
GroupTest test_group(const FitModel& model, const AxisGroup& group, const Told& told,
                     double level) {
    GroupTest test;
    test.group = group.name();
    test.order = group.order;
    test.mirrors = group.mirrors;
    test.mirror_azimuth = std::remainder(group.plane + 0.5 * std::numbers::pi, std::numbers::pi);
    const SymmetricModel symmetric = symmetric_model(told.coordinates, group);
    Eigen::MatrixXd kept(symmetric.columns.rows(),
                         symmetric.columns.cols() + told.coordinates.placement.cols());
    kept << symmetric.columns, told.coordinates.placement;
    kept = range_of(kept, k_repeats, kept.cols());
    // With exact meets the number of ways is known; small asymmetries of the fitted shape would
    // seem to add more.
    const Eigen::MatrixXd ways =
        range_of(orthogonal_part(told.reach, kept), k_repeats,
                 model.meets().splits ? told.reach.cols() : edge_conditions(model, group));
    const QuadraticTest missed =
        quadratic_test(ways.transpose() * symmetric.deviations, congruence(ways, told.covariance),
                       k_exact, k_told_variance);
    test.conditions = missed.conditions;
    test.tested = missed.tested;
    test.chi2 = missed.statistic;
    test.p = missed.p;
    test.determined = test.tested >= k_enough * test.conditions;
    test.supported = test.tested > 0 && test.p >= level;
    return test;
}

// Polar angle and azimuth of facets, two rows each.
struct Directions {
    Eigen::VectorXd deviations;
    Eigen::MatrixXd columns, covariance;
};
Directions directions_of(const std::vector<int>& facets, const SymmetricModel& symmetric,
                         const Eigen::MatrixXd& covariance) {
    std::vector<Eigen::Index> rows;
    for (int f : facets) {
        rows.push_back(Eigen::Index(3 * f));
        rows.push_back(Eigen::Index(3 * f + 1));
    }
    return {symmetric.deviations(rows), symmetric.columns(rows, Eigen::all),
            covariance(rows, rows)};
}

// Without contrasts that the frame or exact conditions make zero (the table's, from which all else
// is measured): they say nothing about symmetry.
Contrasts free_contrasts(const Directions& directions) {
    const Contrasts all =
        contrasts_of(directions.deviations, directions.covariance, directions.columns);
    Contrasts free;
    for (std::size_t i = 0; i < all.values.size(); ++i) {
        const double value = all.values[i], variance = all.variances[i];
        if (!(variance > k_exact) && !(value * value > k_exact)) continue;
        free.values.push_back(value);
        free.variances.push_back(variance);
    }
    return free;
}

// If everything is exact, the stone is symmetric.
VarianceComponent spread_of(const Contrasts& free) {
    return free.values.empty() ? VarianceComponent() : variance_component(free);
}

TierSymmetry test_tier(const FitModel& model, const FacetOrbit& orbit,
                       const SymmetricModel& symmetric, const Eigen::MatrixXd& covariance,
                       const std::vector<Tier>& tiers) {
    TierSymmetry tier;
    for (int f : orbit.facets) {
        tier.facets.push_back(model.stone().solid.facets[std::size_t(f)].name);
    }
    const auto named = std::find_if(tiers.begin(), tiers.end(), [&](const Tier& t) {
        return std::find(t.facets.begin(), t.facets.end(), orbit.facets.front()) != t.facets.end();
    });
    tier.tier = named != tiers.end() ? named->name : tier.facets.front();
    const Directions directions = directions_of(orbit.facets, symmetric, covariance);
    const Eigen::VectorXd off =
        directions.deviations -
        directions.columns * shortest_solution(directions.columns, directions.deviations).col(0);
    for (std::size_t i = 0; i < orbit.facets.size(); ++i) {
        const double angle = std::hypot(off(Eigen::Index(2 * i)), off(Eigen::Index(2 * i + 1)));
        if (angle < tier.worst_off || (i > 0 && angle == tier.worst_off)) continue;
        tier.worst_off = angle;
        tier.worst = tier.facets[i];
    }
    tier.deviation = off.norm() / std::sqrt(double(orbit.facets.size()));
    const Contrasts contrasts = free_contrasts(directions);
    const VarianceComponent component = spread_of(contrasts);
    tier.sigma = component.sigma;
    tier.sigma_sigma = component.sigma_sigma;
    tier.at_most = component.at_most;
    double chi2 = 0;
    int tested = 0;
    for (std::size_t i = 0; i < contrasts.values.size(); ++i) {
        const double variance = contrasts.variances[i];
        if (!(variance > k_exact) || !(variance < k_told_variance)) continue;
        chi2 += contrasts.values[i] * contrasts.values[i] / variance;
        ++tested;
    }
    tier.p = chi2_tail(chi2, tested);
    return tier;
}

std::string cannot_be_tested(const Shape& shape, const Covariance& all) {
    if (shape.normals.size() > k_most_facets) {
        return fmt::format(
            "symmetry was not tested: this stone has {} facets, at most {} are tested; C1 says "
            "nothing about it",
            shape.normals.size(), k_most_facets);
    }
    return all.usable() ? ""
                        : "symmetry was not looked for: the stone has no covariance to test it by";
}

std::string in_degrees(double angle) {
    return fmt::format("{:.2g}", degrees(angle));
}

std::vector<std::string> readings_for(const GroupTest& test, const std::string& how) {
    std::vector<std::string> readings;
    if (test.order > 1) {
        readings.push_back(fmt::format("kind = \"rotation\", of = [\"{}\"], {}", test.order, how));
    }
    if (test.mirrors) {
        readings.push_back(fmt::format("kind = \"mirror\", of = [\"{:.6g}\"], {}",
                                       degrees(test.mirror_azimuth), how));
    }
    return readings;
}

void conclude(SymmetryReport& report) {
    const GroupTest& form = report.groups.front();
    const auto proposed =
        std::find_if(report.groups.begin(), report.groups.end(),
                     [](const GroupTest& test) { return test.supported && test.determined; });
    const std::string spread =
        fmt::format("facets within {} ± {} degrees of it", in_degrees(report.sigma),
                    in_degrees(report.sigma_sigma));
    if (proposed != report.groups.end()) {
        report.proposed = proposed->group;
        report.readings = readings_for(*proposed, "exact = true");
        report.message = fmt::format(
            "{} is supported: chi2 {:.1f} for {} of {} conditions, p {:.2g}", proposed->group,
            proposed->chi2, proposed->tested, proposed->conditions, proposed->p);
        if (proposed == report.groups.begin()) return;
        report.message += fmt::format("; {} is denied (p {:.2g}), {}", form.group, form.p, spread);
    } else if (!form.determined) {
        report.message =
            fmt::format("the readings leave {} open: they test only {} of its {} conditions",
                        form.group, form.tested, form.conditions);
    } else {
        report.message =
            fmt::format("no exact symmetry: {} is denied (chi2 {:.1f} for {}, p {:.2g}); {}",
                        form.group, form.chi2, form.tested, form.p, spread);
        report.readings = readings_for(
            form, fmt::format("sigma = {:.2g}", std::max(1e-6, degrees(report.sigma))));
    }
}

}  // namespace

SymmetryReport symmetry_of(const FitModel& model, const Shape& shape, const Covariance& all,
                           const FitOptions& options) {
    SymmetryReport report;
    const AxisGroup form = form_group(model, shape);
    report.form = form.name();
    report.proposed = form.is_trivial() ? report.form : "C1";
    report.message =
        form.is_trivial() ? "the stone's form has no symmetry" : cannot_be_tested(shape, all);
    if (!report.message.empty()) return report;
    const std::vector<Tier> tiers = tiers_of(model, shape, form);
    Told told{polar_coordinates(model, shape, all.linear().writer, tiers), {}, {}};
    const FunctionRows rows = told.coordinates.rows.sparseView();
    told.covariance = all.joint(rows);
    told.reach = reach_of(all.linear(), rows);
    if (told.reach.size() == 0) {
        report.message = "the meets could not be analysed";
        return report;
    }
    for (const AxisGroup& group : subgroups_of(form)) {
        report.groups.push_back(test_group(model, group, told, options.significance));
    }
    SymmetricModel symmetric = symmetric_model(told.coordinates, form);
    std::vector<int> alike;
    for (const FacetOrbit& orbit : orbits_of(form, shape.normals.size())) {
        // A single facet has nothing to match, unless rotations must leave it level.
        if (orbit.facets.size() == 1 && !orbit.stays && orbit.own_mirror < 0) continue;
        report.tiers.push_back(test_tier(model, orbit, symmetric, told.covariance, tiers));
        alike.insert(alike.end(), orbit.facets.begin(), orbit.facets.end());
    }
    // All tiers together: one alone may be symmetric about an axis of its own.
    const Eigen::Index placed = told.coordinates.placement.cols();
    symmetric.columns.conservativeResize(Eigen::NoChange, symmetric.columns.cols() + placed);
    symmetric.columns.rightCols(placed) = told.coordinates.placement;
    const VarianceComponent whole =
        spread_of(free_contrasts(directions_of(alike, symmetric, told.covariance)));
    report.sigma = whole.sigma;
    report.sigma_sigma = whole.sigma_sigma;
    conclude(report);
    return report;
}

bool declares_whole_symmetry(const Reading& reading) {
    if (reading.kind != ReadingKind::rotation && reading.kind != ReadingKind::mirror) return false;
    return reading.exact || reading.facets.empty();
}

}  // namespace culet
