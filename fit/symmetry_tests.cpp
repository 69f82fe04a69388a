#include "fit/symmetry_tests.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "fit/own_axis.h"
#include "fit/polar_coordinates.h"
#include "fit/statistics.h"
#include "fit/variance_component.h"

namespace culet {

namespace {

// Dense algebra on three numbers a facet; beyond this it would take minutes.
constexpr std::size_t k_most_facets = 700;
// From here on each test costs a good part of a second.
constexpr std::size_t k_many_facets = 150, k_most_groups = 8;
// Told by the readings: better than half of the half diameter.
constexpr double k_told = 0.25;
// Tested at least to this part, a group counts as determined.
constexpr double k_enough = 0.5;

// How many conditions symmetry puts on a shape whose meets are exact: edges less their orbits.
int edge_conditions(const System& system, const AxisGroup& group) {
    std::set<std::pair<int, int>> seen;
    int orbits = 0;
    for (const Edge& e : system.edges().edges) {
        if (seen.count(std::minmax(e.left, e.right)) > 0) continue;
        ++orbits;
        for (const AxisGroup::Element& g : group.elements) {
            seen.insert(std::minmax(g.facets[std::size_t(e.left)], g.facets[std::size_t(e.right)]));
        }
    }
    return static_cast<int>(system.edges().edges.size()) - orbits;
}

Eigen::MatrixXd with(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    Eigen::MatrixXd both(a.rows(), a.cols() + b.cols());
    both << a, b;
    return both;
}

GroupTest test_group(const System& system, const AxisGroup& group,
                     const PolarCoordinates& coordinates, const Eigen::MatrixXd& covariance,
                     const Eigen::MatrixXd& reach, double level) {
    GroupTest test;
    test.group = group.name();
    test.order = group.order;
    test.mirrors = group.mirrors;
    test.mirror_azimuth = std::remainder(group.plane + 0.5 * std::numbers::pi, std::numbers::pi);
    const SymmetricModel model = symmetric_model(coordinates, group);
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(with(model.columns, coordinates.placement));
    qr.setThreshold(1e-9);
    const Eigen::MatrixXd q = qr.householderQ();
    const Eigen::MatrixXd rest = q.rightCols(q.cols() - qr.rank());
    // Of all ways of not being symmetric only those that the meets leave open. Their number is
    // known: without it small asymmetry of the fitted shape itself would show as more.
    const Eigen::MatrixXd open = rest.transpose() * reach * rest;
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> range(open);
    range.setThreshold(1e-6);
    Eigen::Index rank = range.rank();
    if (!system.splits()) rank = std::min<Eigen::Index>(rank, edge_conditions(system, group));
    test.conditions = static_cast<int>(rank);
    if (rank == 0) return test;
    const Eigen::MatrixXd all = range.householderQ();
    const Eigen::MatrixXd ways = rest * all.leftCols(rank);
    const QuadraticTest result = quadratic_test(
        ways.transpose() * model.deviations, ways.transpose() * covariance * ways, 1e-18, k_told);
    test.tested = result.tested;
    test.chi2 = result.statistic;
    test.p = result.p;
    test.determined = test.tested >= k_enough * test.conditions;
    test.supported = test.tested > 0 && test.p >= level;
    return test;
}

TierSymmetry test_tier(const System& system, const FacetOrbit& orbit, const SymmetricModel& model,
                       const Eigen::MatrixXd& covariance, Contrasts& pooled) {
    TierSymmetry tier;
    // Polar angle and azimuth of its facets: directions only.
    std::vector<Eigen::Index> rows;
    for (int f : orbit.facets) {
        tier.facets.push_back(system.stone().solid.facets[std::size_t(f)].name);
        rows.push_back(Eigen::Index(3 * f));
        rows.push_back(Eigen::Index(3 * f + 1));
    }
    const Eigen::Index count = Eigen::Index(rows.size());
    Eigen::VectorXd deviations(count);
    Eigen::MatrixXd columns(count, model.columns.cols()), v(count, count);
    for (Eigen::Index i = 0; i < count; ++i) {
        deviations(i) = model.deviations(rows[std::size_t(i)]);
        columns.row(i) = model.columns.row(rows[std::size_t(i)]);
        for (Eigen::Index k = 0; k < count; ++k) {
            v(i, k) = covariance(rows[std::size_t(i)], rows[std::size_t(k)]);
        }
    }
    const Eigen::VectorXd off =
        deviations - columns * columns.completeOrthogonalDecomposition().solve(deviations);
    double squares = 0;
    for (std::size_t i = 0; i < orbit.facets.size(); ++i) {
        const double angle = std::hypot(off(Eigen::Index(2 * i)), off(Eigen::Index(2 * i + 1)));
        squares += angle * angle;
        if (angle < tier.worst_off || (i > 0 && angle == tier.worst_off)) continue;
        tier.worst_off = angle;
        tier.worst = tier.facets[i];
    }
    tier.deviation = std::sqrt(squares / double(orbit.facets.size()));
    const Contrasts contrasts = contrasts_of(deviations, v, columns);
    const VarianceComponent component = variance_component(contrasts);
    tier.sigma = component.sigma;
    tier.sigma_sigma = component.sigma_sigma;
    tier.at_most = component.at_most;
    double chi2 = 0;
    int tested = 0;
    for (std::size_t i = 0; i < contrasts.values.size(); ++i) {
        if (!(contrasts.variances[i] > 1e-18) || !(contrasts.variances[i] < k_told)) continue;
        chi2 += contrasts.values[i] * contrasts.values[i] / contrasts.variances[i];
        ++tested;
    }
    tier.p = chi2_tail(chi2, tested);
    pooled.values.insert(pooled.values.end(), contrasts.values.begin(), contrasts.values.end());
    pooled.variances.insert(pooled.variances.end(), contrasts.variances.begin(),
                            contrasts.variances.end());
    return tier;
}

std::string in_degrees(double angle) {
    return fmt::format("{:.2g}", degrees(angle));
}

// What a group says in a stone file.
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

void conclude(SymmetryReport& report, double level) {
    const GroupTest* proposed = nullptr;
    for (const GroupTest& test : report.groups) {
        if (test.supported && test.determined && !proposed) proposed = &test;
    }
    const GroupTest& form = report.groups.front();
    const std::string spread =
        fmt::format("facets within {} degrees of it (sigma {})", in_degrees(report.sigma),
                    in_degrees(report.sigma_sigma));
    if (proposed) {
        report.proposed = proposed->group;
        report.readings = readings_for(*proposed, "exact = true");
        report.message = fmt::format(
            "{} is supported: chi2 {:.1f} for {} of {} conditions, p {:.2g}", proposed->group,
            proposed->chi2, proposed->tested, proposed->conditions, proposed->p);
        if (proposed != &form) {
            report.message +=
                fmt::format("; {} is denied (p {:.2g}), {}", form.group, form.p, spread);
        }
        return;
    }
    report.proposed = "C1";
    // A single level facet may be all that is askew: the table that everything else is read from.
    std::string askew;
    bool others = false;
    for (const TierSymmetry& tier : report.tiers) {
        if (tier.p >= level) continue;
        others = others || tier.facets.size() > 1 || !askew.empty();
        askew =
            fmt::format("{}, which stands {} degrees off", tier.tier, in_degrees(tier.worst_off));
    }
    if (!form.determined) {
        report.message =
            fmt::format("the readings leave {} open: they tell of {} of its {} conditions only",
                        form.group, form.tested, form.conditions);
        return;
    }
    report.message =
        fmt::format("no exact symmetry: {} is denied (chi2 {:.1f} for {}, p {:.2g}); {}",
                    form.group, form.chi2, form.tested, form.p, spread);
    if (!askew.empty() && !others) {
        report.message += fmt::format("; the stone would have it but for {}", askew);
    }
    report.readings =
        readings_for(form, fmt::format("sigma = {:.2g}", std::max(1e-6, degrees(report.sigma))));
}

}  // namespace

SymmetryReport symmetry_of(const System& system, const Shape& shape, const Inference& inference,
                           const FitOptions& options) {
    SymmetryReport report;
    const AxisGroup form = form_group(system, shape);
    report.form = report.proposed = form.name();
    if (form.is_trivial()) {
        report.message = "the stone's form has no symmetry";
        return report;
    }
    if (shape.normals.size() > k_most_facets || !inference.usable()) {
        report.proposed = "C1";
        report.message =
            fmt::format("{} facets are too many for the tests of symmetry", shape.normals.size());
        return report;
    }
    const std::vector<Tier> tiers = tiers_of(system, shape, form);
    const PolarCoordinates coordinates = polar_coordinates(system, shape, inference, tiers);
    const Eigen::MatrixXd covariance = inference.covariance(coordinates.rows);
    // What the meets and exact readings leave open at all, whatever was read.
    const Eigen::MatrixXd reach = inference.reach(coordinates.rows);
    if (reach.size() == 0) {
        report.proposed = "C1";
        report.message = "the meets could not be analysed";
        return report;
    }
    for (const AxisGroup& group : subgroups_of(form)) {
        // Subgroups of what is supported follow from it; of large stones they are not asked for one
        // by one.
        if (shape.normals.size() > k_many_facets && !report.groups.empty() &&
            (report.groups.size() >= k_most_groups || report.groups.back().supported)) {
            break;
        }
        report.groups.push_back(
            test_group(system, group, coordinates, covariance, reach, options.significance));
    }
    const SymmetricModel model = symmetric_model(coordinates, form);
    Contrasts pooled;
    for (const FacetOrbit& orbit : orbits_of(form, shape.normals.size())) {
        // A single facet is unlike nothing, unless turns must leave it level.
        if (orbit.facets.size() == 1 && !orbit.stays && orbit.own_mirror < 0) continue;
        TierSymmetry tier = test_tier(system, orbit, model, covariance, pooled);
        tier.tier = tier.facets.front();
        for (const Tier& t : tiers) {
            if (std::find(t.facets.begin(), t.facets.end(), orbit.facets.front()) !=
                t.facets.end()) {
                tier.tier = t.name;
            }
        }
        report.tiers.push_back(std::move(tier));
    }
    const VarianceComponent whole = variance_component(pooled);
    report.sigma = whole.sigma;
    report.sigma_sigma = whole.sigma_sigma;
    conclude(report, options.significance / double(report.tiers.size() + 1));
    return report;
}

SymmetryReport find_symmetry(const Stone& stone, const std::vector<Reading>& readings,
                             const FitOptions& options, const Progress& progress) {
    std::vector<Reading> free;
    for (const Reading& r : readings) {
        if (r.kind != ReadingKind::rotation && r.kind != ReadingKind::mirror) free.push_back(r);
    }
    FitOptions asking = options;
    asking.find_symmetry = true;
    asking.findings = true;
    return fit_stone(stone, free, asking, progress).symmetry.value_or(SymmetryReport());
}

}  // namespace culet
