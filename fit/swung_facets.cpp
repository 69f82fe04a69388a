#include "fit/swung_facets.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

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
// Beyond the ridge of ends up to 10 sigmas apart; no farther than 45 degrees.
constexpr double k_swing = 5;
constexpr double k_farthest_deg = 45 / k_swing;
// Half the half diameter. None of 258 trials that took some corner farther ended better, but 68 of
// 2205 others did (rough meshes of brilliants, pears, trillions and step cuts).
constexpr double k_farthest = 0.5;
// Cosine of steps that are one: facets that swing together.
constexpr double k_together = 0.99;
// Of variances: two digits of a sigma.
constexpr double k_precision = 1e-3;
constexpr int k_most_rounds = 4;

struct Swing {
    double sigma = 0;      // of the facet's direction along its azimuth
    Eigen::VectorXd step;  // of one sigma, of all that is free
};

// Of the facets whose azimuth is least known, the worst first.
std::vector<Swing> swings_at(Relaxation& relaxation, SaddleSolver& solver, const Shape& shape,
                             const std::vector<Held>& held) {
    Softness softness;
    softness.with_priors = false;
    relaxation.choose(shape, true);
    const Sheet sheet = relaxation.sheet(shape, softness, held);
    std::vector<Swing> swings;
    if (!sheet.finite || !solver.factor(sheet.rows, relaxation.metric() / k_unheld_variance))
        return swings;
    const Freedoms& freedoms = relaxation.freedoms();
    const Freedoms::Chart chart = freedoms.chart(shape);
    Freedoms::Row row(chart, freedoms.size());
    SparseRows rows;
    for (std::size_t f = 0; f < shape.normals.size(); ++f) {
        const Vec3& n = shape.normals[f];
        if ((n.x == 0 && n.y == 0) || !freedoms.is_first_facet(static_cast<int>(f))) continue;
        const Vec3 across = glm::normalize(Vec3{-n.y, n.x, 0});
        row.normal(static_cast<int>(f), across);
        row.close(rows, 0, 1);
    }
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(freedoms.size(), rows.count());
    for (int i = 0; i < rows.count(); ++i) {
        for (int k = rows.begin[i]; k < rows.begin[i + 1]; ++k) {
            columns(rows.column[k], i) = rows.slope[k];
        }
    }
    const auto solved = solver.solve_all(columns, Eigen::MatrixXd(), k_precision);
    if (!solved.good) return swings;
    for (Eigen::Index i = 0; i < columns.cols(); ++i) {
        const double sigma = std::sqrt(std::max(0.0, columns.col(i).dot(solved.unknowns.col(i))));
        if (!(sigma > radians(k_weak_deg) && sigma < radians(k_farthest_deg))) continue;
        const Eigen::VectorXd step = solved.unknowns.col(i) / sigma;
        const bool is_known = std::any_of(swings.begin(), swings.end(), [&](const Swing& other) {
            return std::abs(step.dot(other.step)) > k_together * step.norm() * other.step.norm();
        });
        if (!is_known && k_swing * step.cwiseAbs().maxCoeff() < k_farthest) {
            swings.push_back({sigma, step});
        }
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
        const Shape swung = freedoms.moved(from.finished.shape,
                                           {step.data(), static_cast<std::size_t>(step.size())});
        const double goal = from.finished.chi2 - k_same_chi2;
        const Settled settled =
            settle(relaxation, solver, swung, from.held, {.iterations = iterations, .goal = goal});
        if (!(settled.chi2 < goal) || !(settled.worst_hard < k_all_but_met)) return false;
        Candidate there =
            finish_candidate(system, relaxation, settled.shape, {.iterations = iterations});
        if (!there.is_an_end() || !(there.finished.chi2 < goal)) return false;
        there.start = end.start;
        there.agrees = end.agrees;
        there.finished.iterations += from.finished.iterations;
        best = std::move(there);
        return true;
    };
    for (int round = 0; round < k_most_rounds; ++round) {
        const Candidate& from = best ? *best : end;
        const std::vector<Swing> swings =
            swings_at(relaxation, solver, from.finished.shape, from.held);
        const bool gained = std::any_of(swings.begin(), swings.end(), [&](const Swing& swing) {
            return goes_better(swing, k_swing) || goes_better(swing, -k_swing);
        });
        if (!gained) break;
    }
    return best;
}

}  // namespace culet
