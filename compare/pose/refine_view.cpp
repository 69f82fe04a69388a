#include "compare/pose/refine_view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "compare/pose/edge_lines.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

constexpr std::size_t k_fewest_edges = 40;
// Common error of a whole edge's place, pixels, from neighbouring light that the blur mixes in.
constexpr double k_edge_sigma = 0.06;
constexpr int k_settling_rounds = 7;
constexpr int k_groups = 16;
// Half-width of the search: pixels, and sigmas of the facet errors.
constexpr double k_first_width = 0.7, k_width = 0.4, k_facet_widths = 2.5;
// Bounds of the estimated facet errors relative to the expected ones: below, too little caution
// would be left; above, no edges were searched.
constexpr double k_least_error = 0.1, k_most_error = 2;

/// The best edge near the expected place: a strong edge beats a nearer one only while the
/// expectation is vague.
const FoundEdge* best_edge(const std::vector<FoundEdge>& found, double expected, double width) {
    const FoundEdge* best = nullptr;
    double most = 0;
    for (const FoundEdge& edge : found) {
        const double off = (edge.offset - expected) / width;
        const double weight = std::sqrt(edge.contrast) * std::exp(-2 * off * off);
        if (std::abs(off) > 1 || weight <= most) continue;
        most = weight;
        best = &edge;
    }
    return best;
}

/// Either of two edges that the camera hardly separates may be the one seen.
double sigma_at(const WirePoint& point, double sigma) {
    return point.gap < 2.5 ? std::hypot(sigma, 0.5 * point.gap + 0.2) : sigma;
}

/// Meets each point separately.
std::vector<MetEdge> met_points(const EdgePicture& picture, const std::vector<WirePoint>& points,
                                double width) {
    std::vector<MetEdge> met;
    for (const WirePoint& point : points) {
        const std::vector<FoundEdge> found = edges_across(picture, point, width);
        const FoundEdge* edge = best_edge(found, 0, width);
        if (edge == nullptr) continue;
        const double sigma =
            std::hypot(sigma_at(point, edge->sigma), point.facet_sigma, 0.15 * width);
        met.push_back({point, edge->offset, sigma});
    }
    return met;
}

/// Meets whole edges, as far away as the model's errors may move them.
std::vector<MetEdge> met_edges(const EdgePicture& picture, const std::vector<WirePoint>& points,
                               double width_px) {
    const std::vector<double> expected(points.size(), 0.0);
    std::vector<double> width;
    for (const WirePoint& point : points)
        width.push_back(std::hypot(width_px, k_facet_widths * point.facet_sigma));
    std::vector<MetEdge> met;
    for (const MetLine& line : met_lines(picture, points, expected, width)) {
        for (const MetLine::Place& place : line.places) {
            const WirePoint& point = points[static_cast<std::size_t>(place.point)];
            // The points of an edge share its error, so more points do not reduce sigma below this.
            const double together =
                k_edge_sigma * std::sqrt(static_cast<double>(line.places.size()));
            met.push_back({point, place.found.offset,
                           std::hypot(sigma_at(point, place.found.sigma), together)});
        }
    }
    return met;
}

SolverSettings solver_settings(const RefineSettings& settings) {
    SolverSettings solver;
    solver.facet_error = settings.facet_error;
    solver.focal_error = settings.focal_error;
    solver.principal_point_error = settings.principal_point_error;
    return solver;
}

bool ran_away(const StoneView& start, const StoneView& view) {
    const double turn = angle_of(view.turn * glm::transpose(start.turn));
    const double growth = std::abs(std::log(view.scale / start.scale));
    return !(turn < radians(8)) || !(growth < 0.1);
}

}  // namespace

RefinedView refine_roughly(const WireSolid& wire, const EdgePicture& picture,
                           const StoneView& start, const RefineSettings& settings) {
    RefinedView refined;
    refined.solved.view = start;
    const SolverSettings solver = solver_settings(settings);
    WireSpacing spacing;
    spacing.facet_error = settings.facet_error;
    spacing.facet_offset = expected_offset(wire, settings.facet_error);
    spacing.step = std::max(2.0, settings.diameter_px / 120);
    spacing.most_facet_sigma = 0.01 * settings.diameter_px;
    const double widest = std::max(3.0, 0.012 * settings.diameter_px);
    for (double width = widest; width >= 1; width *= 0.5) {
        for (int round = 0; round < 2; ++round) {
            refined.points = points_along(wire, refined.solved.view, spacing);
            refined.met = met_points(picture, refined.points, width);
            if (refined.met.size() < k_fewest_edges) {
                refined.lost = true;
                return refined;
            }
            refined.solved = solve_view(wire, refined.solved.view, refined.met,
                                        settings.prior_focal_px, settings.sight, solver);
            if (!refined.solved.converged || ran_away(start, refined.solved.view)) {
                refined.lost = true;
                return refined;
            }
        }
    }
    return refined;
}

RefinedView refine_fully(const WireSolid& wire, const EdgePicture& picture,
                         const RefinedView& start, const RefineSettings& settings) {
    RefinedView refined = start;
    SolverSettings solver = solver_settings(settings);
    solver.facets_free = true;
    solver.with_covariance = true;
    solver.facet_offset = expected_offset(wire, settings.facet_error);
    WireSpacing spacing;
    spacing.facet_error = settings.facet_error;
    spacing.facet_offset = solver.facet_offset;
    spacing.step = std::max(2.0, settings.diameter_px / 400);
    spacing.most_facet_sigma = 0.004 * settings.diameter_px;
    const double expected_lift = solver.facet_offset;
    for (int round = 0; round < k_settling_rounds; ++round) {
        refined.points = points_along(wire, refined.solved.view, spacing);
        refined.met = met_edges(picture, refined.points, round == 0 ? k_first_width : k_width);
        if (refined.met.size() < k_fewest_edges) {
            refined.lost = true;
            return refined;
        }
        refined.facet_error = solver.facet_error;
        refined.facet_offset = solver.facet_offset;
        refined.solved = solve_view(wire, refined.solved.view, refined.met, settings.prior_focal_px,
                                    settings.sight, solver);
        if (!refined.solved.converged || ran_away(start.solved.view, refined.solved.view)) {
            refined.lost = true;
            return refined;
        }
        const auto near = [](double found, double expected) {
            return std::clamp(found, k_least_error * expected, k_most_error * expected);
        };
        solver.facet_error = near(refined.solved.facet_error, settings.facet_error);
        solver.facet_offset = near(refined.solved.facet_offset, expected_lift);
        // Search as far from the model's edges as its estimated errors move them, but no further
        // than the expected ones.
        spacing.facet_error = std::min(solver.facet_error, settings.facet_error);
        spacing.facet_offset = std::min(solver.facet_offset, expected_lift);
    }
    refined.points = points_along(wire, refined.solved.view, spacing);
    return refined;
}

std::array<double, 6> variances_by_groups(const WireSolid& wire, const RefinedView& refined,
                                          const RefineSettings& settings) {
    SolverSettings solver = solver_settings(settings);
    solver.facets_free = true;
    solver.facet_error = refined.facet_error;
    solver.facet_offset = refined.facet_offset;
    const StoneView& all = refined.solved.view;
    std::array<std::array<double, 6>, k_groups> changes{};
    tbb::parallel_for(0, k_groups, [&](int group) {
        std::vector<MetEdge> rest;
        for (const MetEdge& met : refined.met) {
            if (met.point.edge % k_groups != group) rest.push_back(met);
        }
        const StoneView view =
            solve_view(wire, all, rest, settings.prior_focal_px, settings.sight, solver).view;
        const glm::dmat3 turn = view.turn * glm::transpose(all.turn);
        // Rotation vector of a small rotation.
        changes[static_cast<std::size_t>(group)] = {0.5 * (turn[1][2] - turn[2][1]),
                                                    0.5 * (turn[2][0] - turn[0][2]),
                                                    0.5 * (turn[0][1] - turn[1][0]),
                                                    view.at.x - all.at.x,
                                                    view.at.y - all.at.y,
                                                    std::log(view.scale / all.scale)};
    });
    std::array<double, 6> variances{};
    for (std::size_t k = 0; k < variances.size(); ++k) {
        double mean = 0, squares = 0;
        for (const auto& change : changes) mean += change[k] / k_groups;
        for (const auto& change : changes) squares += (change[k] - mean) * (change[k] - mean);
        variances[k] = squares * (k_groups - 1) / k_groups;
    }
    return variances;
}

}  // namespace culet
