#include "fit/findings/symmetry_tests.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "fit/findings/own_axis.h"
#include "fit/findings/polar_coordinates.h"
#include "fit/findings/symmetry_conclusion.h"
#include "fit/uncertainty/condition_tests.h"
#include "fit/uncertainty/statistics.h"
#include "fit/uncertainty/variance_component.h"
#include "stone/numbers/dense_algebra.h"

namespace culet {

namespace {

// Dense algebra on three numbers a facet; beyond this it would take minutes.
constexpr std::size_t k_most_facets = 700;
// Told by the readings: better than half of the half diameter.
constexpr double k_told_variance = 0.25;
// Exact by other conditions.
constexpr double k_exact = 1e-18;
// Tested at least to this part, a group counts as determined.
constexpr double k_enough = 0.5;

// How many conditions symmetry puts on a shape whose meets are exact: edges less their orbits.
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

// Orthonormal columns for the range of a matrix: at most `most`, none below `least`.
Eigen::MatrixXd range_of(const Eigen::MatrixXd& matrix, double least,
                         Eigen::Index most = std::numeric_limits<int>::max()) {
    if (matrix.size() == 0) return Eigen::MatrixXd(matrix.rows(), 0);
    const PivotedQr qr(matrix);
    most = std::min({most, matrix.rows(), matrix.cols()});
    Eigen::Index rank = 0;
    while (rank < most && qr.pivot(rank) > least) ++rank;
    return qr.first(rank);
}

// What the tests of all groups share.
struct Space {
    Eigen::MatrixXd placement;  // orthonormal: of the symmetry's axis in the stone
    Eigen::MatrixXd open;       // orthonormal: what the meets leave open, but for placement
    Eigen::MatrixXd told;       // of the ways to miss the form's symmetry those that the readings
    Eigen::VectorXd values;     // tell, uncorrelated; the stone's place along them
    Eigen::VectorXd variance;   // and its variance
    Eigen::Index form_freedoms = 0;

    Eigen::MatrixXd without_placement(const Eigen::MatrixXd& matrix) const {
        return without_span(matrix, placement);
    }
};

// Changes of shape that keep a group's symmetry and all meets. A symmetric mean of what the meets
// leave open is open itself, but for as much as the shape is not symmetric: the number of such
// changes is known (edges less conditions), which tells them from that.
Eigen::MatrixXd symmetric_changes(const FitModel& model, const Space& space,
                                  const Eigen::MatrixXd& columns, int edge_conditions) {
    const Eigen::MatrixXd symmetric = range_of(space.without_placement(columns), 1e-9);
    const Eigen::Index most =
        model.meets().splits ? symmetric.cols() : space.open.cols() - Eigen::Index(edge_conditions);
    return product(symmetric, range_of(transpose_times(symmetric, space.open), 1e-6,
                                       std::max<Eigen::Index>(0, most)));
}

Space space_of(const FitModel& model, const AxisGroup& form, const PolarCoordinates& coordinates,
               const Eigen::MatrixXd& covariance, const Eigen::MatrixXd& reach) {
    Space space;
    space.placement = range_of(coordinates.placement, 1e-9);
    const Eigen::MatrixXd seen = space.without_placement(reach);
    // The number of ways that exact meets leave open is known: without it small asymmetry of the
    // fitted shape itself would show as more.
    space.open =
        range_of(space.without_placement(seen.transpose()), 1e-6,
                 model.meets().splits ? reach.rows() : Eigen::Index(model.edges().edges.size()));
    const SymmetricModel symmetric = symmetric_model(coordinates, form);
    const Eigen::MatrixXd changes =
        symmetric_changes(model, space, symmetric.columns, edge_conditions(model, form));
    space.form_freedoms = changes.cols();
    // Across all that is symmetric, reachable or not.
    const Eigen::MatrixXd columns = range_of(space.without_placement(symmetric.columns), 1e-9);
    const Eigen::MatrixXd ways =
        range_of(without_span(space.open, columns), 1e-6, space.open.cols() - changes.cols());
    if (ways.cols() == 0) return space;
    const SymmetricEigen eigen = symmetric_eigen(seen_through(ways, covariance));
    std::vector<Eigen::Index> told;
    for (Eigen::Index i = 0; i < ways.cols(); ++i) {
        const double variance = eigen.values(i);
        if (variance >= k_exact && variance <= k_told_variance) told.push_back(i);
    }
    space.told = product(ways, eigen.vectors(Eigen::all, told));
    space.values = space.told.transpose() * symmetric.deviations;
    space.variance = eigen.values(told);
    return space;
}

// Chi-square of the stone nearest to this one that has the group's symmetry: what a part of the
// form's group leaves free beyond the form's own parameters is fitted by weighted least squares.
GroupTest test_group(const FitModel& model, const AxisGroup& group,
                     const PolarCoordinates& coordinates, const Space& space, double level) {
    GroupTest test;
    test.group = group.name();
    test.order = group.order;
    test.mirrors = group.mirrors;
    test.mirror_azimuth = std::remainder(group.plane + 0.5 * std::numbers::pi, std::numbers::pi);
    const Eigen::MatrixXd changes = symmetric_changes(
        model, space, symmetric_model(coordinates, group).columns, edge_conditions(model, group));
    test.conditions = static_cast<int>(space.open.cols() - changes.cols());
    if (space.told.cols() == 0) return test;
    // Where readings tell nothing of a freedom it is next to nothing here.
    const Eigen::MatrixXd fitted =
        range_of(transpose_times(space.told, changes), 1e-4, changes.cols() - space.form_freedoms);
    const Eigen::VectorXd weights = space.variance.cwiseSqrt().cwiseInverse();
    Eigen::VectorXd left = space.values.cwiseProduct(weights);
    if (fitted.cols() > 0) {
        left = along_completed_basis(weights.asDiagonal() * fitted, std::move(left));
    }
    const Eigen::Index over = left.size() - fitted.cols();
    test.tested = std::min(static_cast<int>(over), test.conditions);
    test.chi2 = left.tail(over).squaredNorm();
    test.p = chi2_tail(test.chi2, test.tested);
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

// But for those that are zero because the frame or exact conditions make them so (the table's, from
// which all else is read): they say nothing of how far a stone is from symmetric.
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

// Where all is held, symmetric it is.
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

// Why a form's symmetry is not looked for; empty: it is.
std::string cannot_be_tested(const Shape& shape, const Covariance& all) {
    if (shape.normals.size() > k_most_facets) {
        return fmt::format(
            "symmetry was not looked for: {} facets are more than the {} up to which it is tested, "
            "so C1 says nothing of this stone",
            shape.normals.size(), k_most_facets);
    }
    return all.usable() ? ""
                        : "symmetry was not looked for: the stone has no covariance to test it by";
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
    const PolarCoordinates coordinates =
        polar_coordinates(model, shape, all.linear().writer, tiers);
    const FunctionRows rows = coordinates.rows.sparseView();
    const Eigen::MatrixXd covariance = all.joint(rows);
    const Eigen::MatrixXd reach = reach_of(all.linear(), rows);
    if (reach.size() == 0) {
        report.message = "the meets could not be analysed";
        return report;
    }
    const Space space = space_of(model, form, coordinates, covariance, reach);
    for (const AxisGroup& group : subgroups_of(form)) {
        report.groups.push_back(test_group(model, group, coordinates, space, options.significance));
    }
    SymmetricModel symmetric = symmetric_model(coordinates, form);
    std::vector<int> alike;
    for (const FacetOrbit& orbit : orbits_of(form, shape.normals.size())) {
        // A single facet is unlike nothing, unless turns must leave it level.
        if (orbit.facets.size() == 1 && !orbit.stays && orbit.own_mirror < 0) continue;
        report.tiers.push_back(test_tier(model, orbit, symmetric, covariance, tiers));
        alike.insert(alike.end(), orbit.facets.begin(), orbit.facets.end());
    }
    // Together: a tier alone may be symmetric about an axis of its own.
    const Eigen::Index placed = coordinates.placement.cols();
    symmetric.columns.conservativeResize(Eigen::NoChange, symmetric.columns.cols() + placed);
    symmetric.columns.rightCols(placed) = coordinates.placement;
    const VarianceComponent whole =
        spread_of(free_contrasts(directions_of(alike, symmetric, covariance)));
    report.sigma = whole.sigma;
    report.sigma_sigma = whole.sigma_sigma;
    conclude(report, options.significance / double(report.tiers.size() + 1));
    return report;
}

bool declares_whole_symmetry(const Reading& reading) {
    if (reading.kind != ReadingKind::rotation && reading.kind != ReadingKind::mirror) return false;
    return reading.exact || reading.facets.empty();
}

}  // namespace culet
