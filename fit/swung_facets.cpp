#include "fit/swung_facets.h"

#include <algorithm>
#include <cmath>

#include "fit/describe.h"
#include "fit/facet_functions.h"
#include "fit/inference.h"
#include "fit/settle.h"
#include "stone/units.h"

namespace culet {

namespace {

// On the sphere of directions. Two ends d apart along which chi-square is a quartic have a ridge of
// d^2 / 16 sigma^2 between them, halfway. Facets that are known better by their edges are so from
// both sides, or their ends are so far apart that other readings tell.
constexpr double k_weak_deg = 1;
constexpr std::size_t k_most_facets = 4;
// Beyond the ridge of ends up to 10 sigmas apart.
constexpr double k_swing = 5;
constexpr double k_farthest_deg = 45;
// Another end, not the same.
constexpr double k_least_gain = 0.1;
constexpr int k_most_rounds = 4;

struct Swing {
    double sigma = 0;      // of the facet's direction along its azimuth
    Eigen::VectorXd step;  // of one sigma
};

// Of the facets whose azimuth is least known, the worst first.
std::vector<Swing> swings_at(const System& system, const Candidate& end) {
    const Shape& shape = end.finished.shape;
    const Inference inference(system, shape, end.finished.outline, conditions_of(shape, end.held));
    std::vector<Swing> swings;
    if (!inference.usable()) return swings;
    const Layout layout = layout_of(shape);
    const Vec3 middle = middle_of(shape);
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(layout.facets, layout.size());
    for (int f = 0; f < layout.facets; ++f) {
        const Vec3& n = shape.normals[std::size_t(f)];
        rows.row(f) = std::hypot(n.x, n.y) *
                      Eigen::VectorXd(facet_functions(shape, f, layout, middle)[1]).transpose();
    }
    const Eigen::MatrixXd with_all = inference.times_covariance(rows);
    for (int f = 0; f < layout.facets; ++f) {
        const double sigma = std::sqrt(std::max(0.0, rows.row(f).dot(with_all.col(f))));
        // Unread altogether is not between two ends.
        if (!(sigma > radians(k_weak_deg)) || !(sigma < radians(k_farthest_deg))) continue;
        swings.push_back({sigma, with_all.col(f) / sigma});
    }
    std::stable_sort(swings.begin(), swings.end(),
                     [](const Swing& a, const Swing& b) { return a.sigma > b.sigma; });
    if (swings.size() > k_most_facets) swings.resize(k_most_facets);
    return swings;
}

}  // namespace

std::optional<Candidate> better_with_facets_swung(const System& system, const Candidate& end,
                                                  int iterations) {
    if (system.splits() || !end.finished.converged) return std::nullopt;
    const Freedoms freedoms = system.freedoms();
    Relaxation relaxation(system, freedoms);
    SaddleSolver solver;
    std::optional<Candidate> best;
    const auto goes_better = [&](const Swing& swing, double by) {
        const Candidate& from = best ? *best : end;
        const Eigen::VectorXd step = by * swing.step;
        const Shape swung = freedoms.symmetrised(
            moved(from.finished.shape, {step.data(), static_cast<std::size_t>(step.size())}));
        const double goal = from.finished.chi2 - k_least_gain;
        const Settled settled =
            settle(relaxation, solver, swung, from.held, {.iterations = iterations, .goal = goal});
        if (!(settled.chi2 < goal) || !(settled.worst_hard < k_hard_limit)) return false;
        Candidate there = finish_candidate(system, relaxation, settled.shape, iterations);
        if (!there.sound || !there.finished.converged || !(there.finished.chi2 < goal) ||
            !(there.finished.worst_hard < k_hard_limit)) {
            return false;
        }
        there.start = end.start;
        there.agrees = end.agrees;
        there.finished.iterations += from.finished.iterations;
        best = std::move(there);
        return true;
    };
    for (int round = 0; round < k_most_rounds; ++round) {
        const std::vector<Swing> swings = swings_at(system, best ? *best : end);
        const bool gained = std::any_of(swings.begin(), swings.end(), [&](const Swing& swing) {
            return k_swing * swing.sigma < radians(k_farthest_deg) &&
                   (goes_better(swing, k_swing) || goes_better(swing, -k_swing));
        });
        if (!gained) break;
    }
    return best;
}

}  // namespace culet
