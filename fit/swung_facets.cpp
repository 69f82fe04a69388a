#include "fit/swung_facets.h"

#include <algorithm>
#include <cmath>

#include "fit/describe.h"
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
    std::vector<Quantity> azimuths;
    std::vector<double> across;  // of a change of azimuth, on the sphere
    for (std::size_t f = 0; f < shape.normals.size(); ++f) {
        const Vec3& n = shape.normals[f];
        if (n.x == 0 && n.y == 0) continue;
        azimuths.push_back(azimuth_error(static_cast<int>(f), -1, 0)(shape));
        across.push_back(std::hypot(n.x, n.y));
    }
    const std::vector<double> sigmas = inference.sigmas(azimuths);
    std::vector<std::size_t> weakest;
    const auto sigma = [&](std::size_t k) { return across[k] * sigmas[k]; };
    for (std::size_t k = 0; k < sigmas.size(); ++k) {
        // Unread altogether is not between two ends.
        if (sigma(k) > radians(k_weak_deg) && sigma(k) < radians(k_farthest_deg)) {
            weakest.push_back(k);
        }
    }
    std::stable_sort(weakest.begin(), weakest.end(),
                     [&](std::size_t a, std::size_t b) { return sigma(a) > sigma(b); });
    if (weakest.size() > k_most_facets) weakest.resize(k_most_facets);
    for (const std::size_t k : weakest) {
        const Eigen::MatrixXd with_all =
            inference.times_covariance(inference.rows_of({azimuths[k]}));
        swings.push_back({sigma(k), with_all.col(0) / sigmas[k]});
    }
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
        const double goal = from.finished.chi2 - k_same_chi2;
        const Settled settled =
            settle(relaxation, solver, swung, from.held, {.iterations = iterations, .goal = goal});
        if (!(settled.chi2 < goal) || !(settled.worst_hard < k_hard_limit)) return false;
        Candidate there = finish_candidate(system, relaxation, settled.shape, iterations);
        if (!there.is_an_end() || !(there.finished.chi2 < goal)) return false;
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
